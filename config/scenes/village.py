"""The village: opaque solids with plane faces at odd attitudes, a test bed for geometry as much as a place."""

import math
import random

from landscape import paint, perturbed, scene, scene_object, texture

HEADER = """
# A village of boxes, cut spheres, cones and cylinders, all opaque: a test bed for geometry. Written by generate.py; edit that.
[scene]
name = "village"
origin = { latitude = 48.0, longitude = 11.0, altitude = 500.0 }
[sun]
azimuth = 230.0
elevation = 38.0
ambient = 0.4
[sky]
horizon = [0.62, 0.72, 0.82]
zenith = [0.14, 0.30, 0.62]
[haze]
visibility = 8000.0
colour = [0.62, 0.72, 0.82]
[ground]
colour = [0.30, 0.40, 0.15]
texture = "grass"
texture_weight = 0.65
"""


class Frame:
    """Axes of a solid in scene space: right, forward, up by heading, pitch and roll, about a place."""

    def __init__(self, place, heading=0.0, pitch=0.0, roll=0.0):
        h, p, r = (math.radians(a) for a in (heading, pitch, roll))
        level_right = (math.cos(h), -math.sin(h), 0.0)
        level_up = (-math.sin(h) * math.sin(p), -math.cos(h) * math.sin(p), math.cos(p))
        forward = (math.sin(h) * math.cos(p), math.cos(h) * math.cos(p), math.sin(p))
        right = tuple(math.cos(r) * a - math.sin(r) * b for a, b in zip(level_right, level_up))
        up = tuple(math.sin(r) * a + math.cos(r) * b for a, b in zip(level_right, level_up))
        self.place, self.axes = place, (right, forward, up)

    def plane(self, normal, offset):
        """The plane normal.q + offset of the solid's own coordinates q, in scene coordinates."""
        scene_normal = [sum(n * axis[k] for n, axis in zip(normal, self.axes)) for k in range(3)]
        return scene_normal + [offset - sum(n * p for n, p in zip(scene_normal, self.place))]

    def quadric(self, squares, linear, constant):
        """Sum of squares_i q_i2 + linear_i q_i + constant of the solid's own coordinates, as ten scene coefficients."""
        m = [[sum(s * axis[i] * axis[j] for s, axis in zip(squares, self.axes)) for j in range(3)] for i in range(3)]
        v = [sum(l * axis[i] for l, axis in zip(linear, self.axes)) for i in range(3)]
        at_place = [sum(m[i][j] * self.place[j] for j in range(3)) for i in range(3)]
        gradient = [v[i] - 2.0 * at_place[i] for i in range(3)]
        rest = sum(self.place[i] * (at_place[i] - v[i]) for i in range(3)) + constant
        ten = [m[0][0], m[1][1], m[2][2], 2.0 * m[0][1], 2.0 * m[1][2], 2.0 * m[0][2]] + gradient + [rest]
        return "quadric = [" + ", ".join(repr(float(f"{t:.15g}")) for t in ten) + "]"


def box(frame, right, forward, up):
    """Half lengths; the quadric is a sphere that lies beyond every corner."""
    planes = []
    for axis, half in enumerate((right, forward, up)):
        for sign in (1.0, -1.0):
            normal = [0.0, 0.0, 0.0]
            normal[axis] = -sign
            planes.append(frame.plane(normal, half))
    return frame.quadric((1, 1, 1), (0, 0, 0), -1.21 * (right**2 + forward**2 + up**2)), planes


def roof(frame, right, forward, rise):
    """A ridge along forward over a rectangle of half lengths, eaves at the frame's height."""
    planes = [frame.plane((-rise, 0, -right), rise * right), frame.plane((rise, 0, -right), rise * right), frame.plane((0, -1, 0), forward),
              frame.plane((0, 1, 0), forward), frame.plane((0, 0, 1), 0.0)]
    return frame.quadric((1, 1, 1), (0, 0, 0), -1.21 * (right**2 + forward**2 + rise**2)), planes


def cylinder(frame, radius, length, slant=0.0):
    """Along up, from 0 to length; the upper plane leans by its slant."""
    planes = [frame.plane((0, 0, 1), 0.0), frame.plane((slant, 0, -1), length)]
    return frame.quadric((1, 1, 0), (0, 0, 0), -radius**2), planes


def cone(frame, radius, height):
    """Apex at height above the frame; the plane through the frame and one at the apex leave one nappe."""
    slope = (radius / height)**2
    planes = [frame.plane((0, 0, 1), 0.0), frame.plane((0, 0, -1), height)]
    return frame.quadric((1, 1, -slope), (0, 0, 2.0 * slope * height), -slope * height**2), planes


def cut_sphere(frame, radius, *cuts):
    """Keeps what lies below each cut's height along its own normal."""
    planes = [frame.plane([-c for c in normal], height) for normal, height in cuts]
    return frame.quadric((1, 1, 1), (0, 0, 0), -radius**2), planes


def dish(frame, radius, depth):
    """A paraboloid bowl opening upwards, its rim closed by a plane."""
    return frame.quadric((1, 1, 0), (0, 0, -radius**2 / depth), 0.0), [frame.plane((0, 0, -1), depth)]


def dome(frame, radius_of_curvature, slope, height):
    """The lower sheet of a two-sheet hyperboloid about the frame's apex, upside down a bell."""
    c = radius_of_curvature * slope**2
    return (frame.quadric((slope**2, slope**2, -1), (0, 0, 2.0 * c), 0.0),
            [frame.plane((0, 0, -1), 0.0), frame.plane((0, 0, 1), height)])


WALLS = [(0.85, 0.80, 0.68), (0.75, 0.62, 0.45), (0.88, 0.86, 0.82), (0.62, 0.66, 0.60), (0.80, 0.55, 0.40)]
ROOFS = [(0.55, 0.16, 0.09), (0.42, 0.14, 0.09), (0.30, 0.28, 0.28), (0.50, 0.26, 0.12)]
METAL = (0.55, 0.58, 0.62)


def village():
    dice = random.Random(48)
    objects = []

    def add(kind, solid, colour, texture_name=None, weight=0.0):
        shape, planes = solid
        objects.append(scene_object(f"{kind}-{len(objects) + 1}", shape, planes,
                                    paint(perturbed(dice, colour, 0.1), texture_name, weight)))

    for row in range(3):  # houses along three streets, each a box and a roof
        for column in range(6):
            x = -62.0 + 25.0 * column + dice.uniform(-3, 3)
            y = 40.0 + 34.0 * row + dice.uniform(-4, 4)
            heading = dice.choice((0.0, 90.0)) + dice.uniform(-14, 14)
            right, forward, up = dice.uniform(3.5, 5.0), dice.uniform(4.5, 7.5), dice.uniform(1.6, 3.2)
            add("house", box(Frame((x, y, up), heading), right, forward, up), dice.choice(WALLS), "plaster", 0.25)
            add("roof", roof(Frame((x, y, 2.0 * up), heading), right + 0.5, forward + 0.6, dice.uniform(2.2, 4.0)), dice.choice(ROOFS), "plaster", 0.35)

    place = (4.0, 92.0)  # the church
    add("nave", box(Frame((place[0], place[1] + 14.0, 5.0), 8.0), 5.0, 12.0, 5.0), WALLS[2])
    add("nave-roof", roof(Frame((place[0], place[1] + 14.0, 10.0), 8.0), 5.6, 12.4, 6.0), ROOFS[2])
    add("tower", box(Frame((place[0], place[1], 10.0), 8.0), 3.2, 3.2, 10.0), WALLS[2])
    add("spire", cone(Frame((place[0], place[1], 20.0)), 3.4, 14.0), (0.16, 0.34, 0.28))
    add("orb", cut_sphere(Frame((place[0], place[1], 34.0)), 0.7), (0.9, 0.7, 0.2))
    add("apse", cut_sphere(Frame((place[0] + 3.6, place[1] + 26.0, 0.0), 8.0), 6.0, ((0, -1, 0), 1.0), ((0, 0, -1), 0.0)), WALLS[2])

    for i in range(3):  # silos with domes
        x, y = 82.0 + 9.0 * i, 60.0 + 4.0 * i
        add("silo", cylinder(Frame((x, y, 0.0)), 3.6, 11.0 + i), METAL)
        add("silo-dome", cut_sphere(Frame((x, y, 11.0 + i)), 3.6, ((0, 0, -1), 0.0)), METAL)
    for i in range(4):  # tanks lying down, their ends cut askew
        add("tank", cylinder(Frame((86.0, 92.0 + 8.0 * i, 2.2), 100.0 + 9.0 * i, -90.0 + 4.0 * i), 2.1, 10.0, 0.4 * (i - 1)), (0.7, 0.25 + 0.1 * i, 0.2))
    add("water-shaft", cylinder(Frame((-86.0, 70.0, 0.0)), 1.2, 20.0), METAL)
    add("water-tank", cut_sphere(Frame((-86.0, 70.0, 22.0), 20.0), 5.5, ((0, 0, 1), 4.2), ((0.3, 0, -0.95), 3.9)), (0.55, 0.70, 0.82))
    add("dish", dish(Frame((-78.0, 100.0, 6.0), 150.0, -40.0), 5.0, 2.2), (0.9, 0.9, 0.9))
    add("bell", dome(Frame((-60.0, 140.0, 15.0)), 3.0, 1.4, 15.0), (0.45, 0.30, 0.12))
    add("bell-askew", dome(Frame((-40.0, 148.0, 10.0), 30.0, 20.0, 15.0), 2.5, 1.2, 7.0), (0.45, 0.30, 0.12))

    for i in range(8):  # marquees: cones standing askew
        frame = Frame((-75.0 + 13.0 * i, 22.0 + dice.uniform(-3, 3), 0.4), dice.uniform(0, 360), dice.uniform(-12, 12), dice.uniform(-12, 12))
        add("tent", cone(frame, dice.uniform(2.0, 3.2), dice.uniform(3.0, 5.0)), (0.85, dice.uniform(0.2, 0.8), 0.25))
    for i in range(12):  # boulders: spheres cut by three to six planes
        frame = Frame((dice.uniform(-90, 90), dice.uniform(8, 150), 0.5), dice.uniform(0, 360), dice.uniform(-40, 40), dice.uniform(-40, 40))
        radius = dice.uniform(1.2, 2.4)
        cuts = []
        for _ in range(dice.randint(3, 6)):
            z, turn = dice.uniform(-1, 1), dice.uniform(0, 2 * math.pi)
            across = math.sqrt(1 - z * z)
            cuts.append(((across * math.cos(turn), across * math.sin(turn), z), radius * dice.uniform(0.5, 0.85)))
        add("boulder", cut_sphere(frame, radius, *cuts), (0.5, 0.48, 0.44), "stone", 0.5)
    for i in range(8):  # crates thrown about
        frame = Frame((dice.uniform(-30, 60), dice.uniform(10, 36), 1.2), dice.uniform(0, 360), dice.uniform(-50, 50), dice.uniform(-180, 180))
        add("crate", box(frame, dice.uniform(0.6, 1.4), dice.uniform(0.6, 1.4), dice.uniform(0.6, 1.4)), (0.55, 0.40, 0.20), "plaster", 0.3)

    parts = [texture("grass", 60.0, 6, dice), texture("plaster", 3.0, 4, dice, 0.6), texture("stone", 1.5, 4, dice, 0.7)]
    return scene(HEADER, parts + objects)
