"""Parts that landscapes are made of, as text of a scene file: textures, ranges of hills, woods and clouds.

Clusters after Gardner 1984, 2.3: a template object set down over a region at some spacing, its place, size, shape and colour
perturbed at random; abutting hills cut by the plane in which they meet; trees raised to the height of the hill they stand on.
All randomness comes from the generator handed in, so a seed fixes a scene. Lengths in metres, angles in degrees.
"""

import math


def number(value):
    """At most 9 significant digits, and always a TOML float."""
    text = f"{value + 0.0:.9g}"
    return text if any(c in text for c in ".en") else text + ".0"


def numbers(values):
    return "[" + ", ".join(number(v) for v in values) + "]"


def rounded(values, digits=3):
    return [round(v, digits) for v in values]


def texture(name, longest, terms, phases, vertical=0.0, drift=(0.0, 0.0), step=2.07):
    """Frequencies about twice, amplitudes about 0.7 times the one before (2.3); `longest` is the first term's wavelength."""
    frequencies = [2.0 * math.pi / longest * step**i for i in range(terms)]
    return "\n".join([
        "[[texture]]",
        f'name = "{name}"',
        f"coefficients = {numbers(rounded(0.707**i for i in range(terms)))}",
        f"frequencies = {numbers(float(f'{f:.5g}') for f in frequencies)}",
        f"phases = {numbers(rounded((phases.uniform(0.0, 2.0 * math.pi) for _ in range(terms)), 2))}",
        f"vertical = {number(vertical)}",
        f"drift = {numbers(drift)}",
    ])


def paint(colour, texture_name=None, weight=0.0, translucence=None):
    lines = [f"colour = {numbers(rounded(min(1.0, max(0.0, c)) for c in colour))}"]
    if texture_name:
        lines += [f'texture = "{texture_name}"', f"texture_weight = {number(weight)}"]
    if translucence:
        threshold, limb, softness = translucence
        lines.append(f"translucence = {{ threshold = {number(threshold)}, limb_threshold = {number(limb)}, softness = {number(softness)} }}")
    return "\n".join(lines)


def scene_object(name, shape, planes, paint_text):
    lines = ["[[object]]", f'name = "{name}"', shape]
    if planes:
        lines.append("planes = [" + ", ".join(numbers(p) for p in planes) + "]")
    return "\n".join(lines + [paint_text])


def ellipsoid(centre, semi_axes, heading=0.0):
    return (f"ellipsoid = {{ centre = {numbers(rounded(centre, 2))}, semi_axes = {numbers(rounded(semi_axes, 2))}, "
            f"heading = {number(round(heading, 1))} }}")


def perturbed(random, colour, amount):
    """One brightness and a little of every colour at random."""
    brightness = random.uniform(1.0 - amount, 1.0 + amount)
    return [c * brightness * random.uniform(1.0 - 0.5 * amount, 1.0 + 0.5 * amount) for c in colour]


class Range:
    """Hills of one far slope m whose hyperboloids have their centres at one height K.

    The lower sheet of hill i is m2 ((X-Xi)2 + (Y-Yi)2) - (Z-K)2 + ci2 = 0 with ci = K - apex height. Two of them differ by a linear
    form in X and Y, so they meet in an upright plane, and cutting both there leaves the same mountain with nothing counted twice.
    """

    def __init__(self, name, slope, height_of_centres, most_neighbours=5):
        self.name, self.slope, self.centres, self.most_neighbours = name, slope, height_of_centres, most_neighbours
        self.hills = []  # (x, y, apex height)

    def add(self, x, y, apex):
        self.hills.append((round(x, 1), round(y, 1), round(apex, 1)))

    def foot(self, hill):
        """Radius of the hill where it meets the ground."""
        c = self.centres - hill[2]
        return math.sqrt(self.centres**2 - c**2) / self.slope

    def height(self, x, y):
        """Height of the surface above the ground, 0 beside the hills."""
        heights = [0.0]
        for hx, hy, apex in self.hills:
            c = self.centres - apex
            heights.append(self.centres - math.sqrt(c**2 + self.slope**2 * ((x - hx)**2 + (y - hy)**2)))
        return max(heights)

    def cut(self, one, other):
        """The plane that keeps `one` on its own side, of unit normal."""
        form = lambda h: (-2.0 * self.slope**2 * h[0], -2.0 * self.slope**2 * h[1],
                          self.slope**2 * (h[0]**2 + h[1]**2) + (self.centres - h[2])**2)
        a, b = form(one), form(other)
        plane = [b[0] - a[0], b[1] - a[1], 0.0, b[2] - a[2]]
        size = math.hypot(plane[0], plane[1])
        return [p / size for p in plane]

    def neighbours(self):
        """Pairs of hills that run into each other, nearest first, no hill in more than it has planes for."""
        pairs = []
        for i, one in enumerate(self.hills):
            for j in range(i):
                other = self.hills[j]
                gap = math.dist(one[:2], other[:2]) - self.foot(one) - self.foot(other)
                if gap < 0.0:
                    pairs.append((gap, i, j))
        cuts = {i: [] for i in range(len(self.hills))}
        for _, i, j in sorted(pairs):
            if len(cuts[i]) < self.most_neighbours and len(cuts[j]) < self.most_neighbours:
                cuts[i].append(j)
                cuts[j].append(i)
        return cuts

    def objects(self, random, colour, texture_name, weight):
        cuts = self.neighbours()
        for i, hill in enumerate(self.hills):
            planes = [[0.0, 0.0, 1.0, 0.0]] + [self.cut(hill, self.hills[j]) for j in cuts[i]]
            radius = (self.centres - hill[2]) / self.slope**2
            shape = (f"hill = {{ apex = {numbers(hill)}, radius_of_curvature = {number(radius)}, "
                     f"slope = {number(self.slope)} }}")
            yield scene_object(f"{self.name}-{i + 1}", shape, planes, paint(perturbed(random, colour, 0.12), texture_name, weight))


def skyline(eye, centre, size, ranges):
    """Whether a cloud of that size about `centre` is seen clear above every hill that an eye there has before or behind it."""
    dx, dy = centre[0] - eye[0], centre[1] - eye[1]
    distance = math.hypot(dx, dy)
    low = math.atan2(centre[2] - 0.4 * size - eye[2], distance + size)
    for hills in ranges:
        for hill in hills.hills:
            hx, hy = hill[0] - eye[0], hill[1] - eye[1]
            away = math.hypot(hx, hy)
            aside = abs(math.atan2(dx * hy - dy * hx, dx * hx + dy * hy))
            if aside < math.atan2(size, distance) + math.atan2(0.7 * hills.foot(hill), away) and low < math.atan2(hill[2] - eye[2], away):
                return False
    return True


def foliage(random):
    """Greens from olive to blue-green, a few of them turning."""
    kind = random.random()
    if kind < 0.05:
        base = (0.32, 0.27, 0.06)
    elif kind < 0.45:
        base = (0.17, 0.29, 0.06)
    elif kind < 0.85:
        base = (0.10, 0.26, 0.07)
    else:
        base = (0.07, 0.19, 0.09)
    return perturbed(random, base, 0.3)


def tree(random, name, x, y, ground, height):
    """A crown whose lowest part lies in the ground: what is seen of it then stands on the ground, for all the holes at its limb."""
    wide = height * random.uniform(0.3, 0.48)
    up = 0.56 * height
    shape = ellipsoid((x, y, ground + height - up), (wide, wide * random.uniform(0.8, 1.1), up), random.uniform(0.0, 180.0))
    translucence = (round(random.uniform(0.05, 0.1), 3), round(random.uniform(0.36, 0.5), 3), 0.08)
    return scene_object(name, shape, [], paint(foliage(random), "foliage", 0.55, translucence))


def copse(random, name, x, y, ground, size, height):
    """A whole wood as one ellipsoid, for where its trees would be a few pixels each."""
    up = 1.15 * height
    shape = ellipsoid((x, y, ground + height - up), (size, size * random.uniform(0.4, 0.8), up), random.uniform(0.0, 180.0))
    return scene_object(name, shape, [], paint(foliage(random), "copse", 0.6, (0.08, 0.34, 0.08)))


def cloud(random, name, x, y, base, size, flat_bottom=False):
    semi_axes = (size * random.uniform(0.7, 1.3), size * random.uniform(0.4, 0.7), size * random.uniform(0.24, 0.36))
    shape = ellipsoid((x, y, base), semi_axes, random.uniform(60.0, 120.0))
    planes = [[0.0, 0.0, 1.0, -round(base - 0.25 * semi_axes[2], 1)]] if flat_bottom else []
    white = random.uniform(0.93, 1.0)
    return scene_object(name, shape, planes, paint((white, white, white), "cumulus", 0.25, (0.1, 0.62, 0.14)))


def heap_cloud(random, name, x, y, base, size, puffs):
    """A cumulus as a cluster: one broad ellipsoid, and rounder ones that rise out of it."""
    bearing = random.uniform(0.0, math.pi)
    for i in range(puffs):
        along, aside = (0.0, 0.0) if i == 0 else (random.uniform(-0.65, 0.65) * size, random.uniform(-0.25, 0.25) * size)
        wide = size if i == 0 else size * random.uniform(0.35, 0.55)
        up = size * 0.26 if i == 0 else wide * random.uniform(0.6, 0.85)
        centre = (x + along * math.sin(bearing) + aside * math.cos(bearing), y + along * math.cos(bearing) - aside * math.sin(bearing),
                  base if i == 0 else base + 0.12 * size)
        shape = ellipsoid(centre, (wide * random.uniform(0.5, 0.75), wide, up), math.degrees(bearing))
        yield scene_object(f"{name}-{i + 1}", shape, [], paint((1.0, 1.0, 1.0), "cumulus", 0.2, (0.06, 0.5, 0.16)))


def scene(header, parts):
    return header.strip() + "\n\n" + "\n\n".join(parts) + "\n"
