#!/usr/bin/env python3
"""Writes the landscapes of the recorded flights and the village beside itself: python3 generate.py

Nothing needs this at build or run time; the scenes are part of the repository, and the same script gives the same files.
"""

import math
import pathlib
import random

from landscape import Range, cloud, copse, ellipsoid, heap_cloud, paint, perturbed, scene, scene_object, skyline, texture, tree
from village import village

# Where the Cessna's eye goes, east and north of the origin: round on the ground, off, and climbing to 95 m.
TAKEOFF_PATH = [(10, -1), (-26, 18), (-60, 15), (-84, -5), (-136, -71), (-185, -164), (-240, -270), (-283, -368), (-315, -467),
                (-348, -573), (-380, -679), (-409, -778), (-440, -876), (-472, -982), (-620, -1420)]

TAKEOFF_HEADER = """
# The landscape of the recorded take-off of a Cessna 172. Written by generate.py; edit that.
[scene]
name = "takeoff"
origin = { latitude = 29.7597, longitude = -95.1640, altitude = -0.6 }
[sun]
azimuth = 75.0
elevation = 30.0
ambient = 0.54
[sky]
horizon = [0.60, 0.71, 0.83]
zenith = [0.12, 0.27, 0.60]
[haze]
visibility = 42000.0
colour = [0.60, 0.71, 0.83]
[ground]
colour = [0.30, 0.41, 0.14]
texture = "grass"
texture_weight = 0.62
[[cloud_deck]]
altitude = 3200.0
colour = [1.0, 1.0, 1.0]
texture = "high-cloud"
texture_weight = 0.1
translucence = { threshold = 0.34, limb_threshold = 0.34, softness = 0.35 }
"""


def distance_to_path(x, y, path):
    nearest = math.inf
    for (ax, ay), (bx, by) in zip(path, path[1:]):
        dx, dy = bx - ax, by - ay
        along = max(0.0, min(1.0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)))
        nearest = min(nearest, math.hypot(x - ax - along * dx, y - ay - along * dy))
    return nearest


def climb_out(ahead, right):
    """East and north of a place seen from where the recording ends, in metres ahead of the eye and to its right."""
    heading = math.radians(199.5)
    return (-472.0 + ahead * math.sin(heading) + right * math.cos(heading), -982.0 + ahead * math.cos(heading) - right * math.sin(heading))


def takeoff():
    dice = random.Random(1984)
    ridge = Range("ridge", 0.42, 480.0)
    for i in range(13):
        along = -2600.0 + 430.0 * i + dice.uniform(-120, 120)
        back = dice.uniform(-350, 350)
        ridge.add(-1500.0 + along * 0.93 - back * 0.36, -4300.0 - along * 0.36 - back * 0.93, dice.uniform(150, 360))
    west = Range("west-down", 0.3, 190.0)
    for i in range(11):
        west.add(-900.0 + dice.uniform(-500, 350), -650.0 + 190.0 * i + dice.uniform(-60, 60), dice.uniform(30, 95))
    downs = Range("down", 0.36, 230.0)  # on both sides of a valley that the climb-out looks along
    for ahead, right, apex in [(420, -560, 48), (820, -640, 80), (1180, -1010, 115), (1320, -470, 62), (1750, -760, 122), (2080, -330, 84),
                               (2300, -1180, 150), (2700, -620, 140), (620, 640, 66), (1010, 480, 54), (1330, 900, 118), (1600, 430, 70),
                               (1950, 820, 128), (2250, 330, 92), (2500, 1150, 155), (2800, 620, 138), (2900, 0, 105)]:
        x, y = climb_out(ahead + dice.uniform(-60, 60), right + dice.uniform(-50, 50))
        downs.add(x, y, apex * dice.uniform(0.9, 1.1))
    far = Range("mountain", 0.62, 1300.0)
    for i in range(22):
        bearing = math.radians(142.0 + 8.2 * i + dice.uniform(-5, 5))
        distance = dice.uniform(8500, 13500)
        far.add(distance * math.sin(bearing), distance * math.cos(bearing), dice.uniform(380, 1230))
    near = [ridge, west, downs]

    parts = [texture("grass", 330.0, 6, dice, step=2.6), texture("hillside", 260.0, 5, dice, 0.3), texture("rock", 1500.0, 5, dice, 0.3),
             texture("foliage", 7.0, 5, dice, 0.75), texture("copse", 26.0, 4, dice, 0.75), texture("cumulus", 420.0, 5, dice, 0.6, (4.0, 1.0)),
             texture("high-cloud", 9000.0, 4, dice, 0.0, (12.0, 5.0))]
    # The grass goes on up the downs, in nearly its own colour: no seam where they rise.
    parts += downs.objects(dice, (0.33, 0.42, 0.15), "grass", 0.6)
    parts += west.objects(dice, (0.35, 0.42, 0.16), "grass", 0.6)
    parts += ridge.objects(dice, (0.36, 0.38, 0.17), "hillside", 0.62)
    parts += far.objects(dice, (0.34, 0.36, 0.28), "rock", 0.55)

    woods = []

    def height(x, y):
        return max(r.height(x, y) for r in near)

    def plant(x, y, tall):
        clear = 34.0 if y > -300.0 else 60.0
        if distance_to_path(x, y, TAKEOFF_PATH) > clear:
            woods.append(tree(dice, f"tree-{len(woods) + 1}", x, y, height(x, y), tall))

    def grove(x, y, spread, count, tall):
        for _ in range(count):
            plant(x + dice.gauss(0, spread), y + dice.gauss(0, spread), tall * dice.uniform(0.65, 1.3))

    for i in range(22):  # woods along both sides of the runway
        t = dice.uniform(0.0, 0.6)
        side = dice.choice((-1.0, 1.0))
        grove(-136.0 - 320.0 * t + side * dice.uniform(55, 140), -71.0 - 1000.0 * t + dice.uniform(-40, 40), 22.0, 7, 10.0)
    for i in range(12):  # round the apron
        bearing = math.radians(dice.uniform(190, 390))
        grove(-40 + 120 * math.sin(bearing), 120 * math.cos(bearing), 24.0, 7, 9.0)
    for i in range(45):  # on the downs behind the apron
        x, y, _ = dice.choice(west.hills)
        plant(x + dice.gauss(0, 130), y + dice.gauss(0, 130), dice.uniform(8, 14))
    for i in range(40):  # groves under the climb-out and along the valley
        ahead = dice.uniform(-350.0, 1700.0)
        side = dice.choice((-1.0, 1.0))
        x, y = climb_out(ahead, side * (90.0 + dice.random() * (260.0 + 0.3 * max(0.0, ahead))))
        grove(x, y, 24.0, 6, 13.0)
    for i in range(60):  # single trees on the downs
        x, y, _ = dice.choice(downs.hills)
        plant(x + dice.gauss(0, 150), y + dice.gauss(0, 150), dice.uniform(10, 17))
    for i in range(90):  # woods of the far downs and of the ridge's near side
        x, y = climb_out(dice.uniform(1500, 3600), dice.uniform(-1800, 1800))
        woods.append(copse(dice, f"copse-{i + 1}", x, y, height(x, y), dice.uniform(22, 60), dice.uniform(12, 17)))
    parts += woods

    for i in range(30):
        bearing = math.radians(dice.uniform(160, 390))
        distance = dice.uniform(4000, 11000)
        x, y, base = distance * math.sin(bearing), distance * math.cos(bearing), dice.uniform(900, 1700)
        size = dice.uniform(280, 560)
        eyes = [(0.0, 0.0, 1.0), (-472.0, -982.0, 95.0)]
        if all(skyline(eye, (x, y, base), 1.6 * size, near + [far]) for eye in eyes):
            parts += heap_cloud(dice, f"cloud-{i + 1}", x, y, base, size, 3)
    return scene(TAKEOFF_HEADER, parts)


# Where the 737's eye goes, east and north of the origin, and its heading, every 6 s.
TURN_PATH = [(-5222, -5366, 8), (-4956, -4024, 17), (-4495, -2736, 25), (-3848, -1531, 34), (-3031, -436, 42), (-2060, 524, 51),
             (-959, 1330, 59), (249, 1961, 68), (1537, 2406, 76), (2876, 2655, 85), (4233, 2702, 93)]

TURN_HEADER = """
# The landscape of the recorded turn of a Boeing 737 at 7620 m. Written by generate.py; edit that.
[scene]
name = "turn"
origin = { latitude = 47.25, longitude = 122.07, altitude = 3600.0 }
[sun]
azimuth = 235.0
elevation = 42.0
ambient = 0.6
[sky]
horizon = [0.55, 0.70, 0.86]
zenith = [0.07, 0.19, 0.52]
[haze]
visibility = 200000.0
colour = [0.55, 0.70, 0.86]
[ground]
colour = [0.28, 0.38, 0.15]
texture = "plain"
texture_weight = 0.75
[[cloud_deck]]
altitude = 2300.0
colour = [1.0, 1.0, 1.0]
texture = "broken-cloud"
texture_weight = 0.2
translucence = { threshold = 0.40, limb_threshold = 0.40, softness = 0.16 }
[[cloud_deck]]
altitude = 8000.0
colour = [1.0, 1.0, 1.0]
texture = "high-cloud"
texture_weight = 0.1
translucence = { threshold = 0.36, limb_threshold = 0.36, softness = 0.4 }
"""


def turn():
    dice = random.Random(737)
    parts = [texture("plain", 9000.0, 7, dice), texture("mountainside", 5200.0, 7, dice, 0.3), texture("crag", 1900.0, 6, dice, 0.4),
             texture("wood", 900.0, 6, dice, 0.5), texture("cumulus", 1500.0, 6, dice, 0.6, (12.0, 4.0)),
             texture("broken-cloud", 7000.0, 7, dice, 0.0, (14.0, 6.0)), texture("high-cloud", 30000.0, 6, dice, 0.0, (25.0, 5.0))]
    first_chain = Range("north-chain", 0.5, 3300.0)
    for i in range(16):
        first_chain.add(-14000.0 + 2600.0 * i + dice.uniform(-900, 900), 19000.0 + 500.0 * i + dice.uniform(-2200, 2200),
                        dice.uniform(900, 2500))
    second_chain = Range("east-chain", 0.55, 3800.0)
    for i in range(16):
        second_chain.add(25000.0 + 900.0 * i + dice.uniform(-2500, 2500), 21000.0 - 3000.0 * i + dice.uniform(-900, 900),
                         dice.uniform(1100, 3000))
    foothills = Range("foothill", 0.25, 900.0)
    for i in range(18):
        foothills.add(dice.uniform(-9000, 21000), dice.uniform(6000, 15000), dice.uniform(120, 480))
    far_chain = Range("far-chain", 0.6, 4200.0)
    for i in range(20):
        bearing = math.radians(-35.0 + 9.5 * i + dice.uniform(-3, 3))
        distance = dice.uniform(52000, 70000)
        far_chain.add(distance * math.sin(bearing), distance * math.cos(bearing), dice.uniform(1500, 3200))
    # The recording's host asks for a visibility of 20 km: what it is to see stands near its path, on a plateau 4 km below it.
    near_peaks = Range("peak", 0.95, 3550.0)
    for x, y, heading in TURN_PATH:
        for _ in range(4):
            bearing = math.radians(heading + dice.uniform(-15.0, 42.0))
            distance = dice.uniform(4200, 9500)
            near_peaks.add(x + distance * math.sin(bearing), y + distance * math.cos(bearing), dice.uniform(900, 3400))
    parts += near_peaks.objects(dice, (0.30, 0.27, 0.12), "crag", 0.8)
    parts += first_chain.objects(dice, (0.38, 0.36, 0.17), "mountainside", 0.7)
    parts += second_chain.objects(dice, (0.44, 0.36, 0.22), "mountainside", 0.7)
    parts += foothills.objects(dice, (0.30, 0.40, 0.14), "mountainside", 0.7)
    parts += far_chain.objects(dice, (0.36, 0.36, 0.34), "mountainside", 0.55)

    for i in range(260):  # a wood is a low translucent dome from up here
        bearing = math.radians(dice.uniform(-40, 150))
        distance = dice.uniform(9000, 36000)
        x, y = distance * math.sin(bearing), distance * math.cos(bearing)
        if max(r.height(x, y) for r in (first_chain, second_chain, foothills, near_peaks)) > 0.0:
            continue
        size = dice.uniform(300, 1100)
        shape = ellipsoid((x, y, 0.0), (size, size * dice.uniform(0.4, 0.9), dice.uniform(25, 45)), dice.uniform(0, 180))
        parts.append(scene_object(f"wood-{i + 1}", shape, [], paint(perturbed(dice, (0.10, 0.22, 0.07), 0.3), "wood", 0.5,
                                                                   (0.12, 0.3, 0.08))))
    for i in range(70):
        bearing = math.radians(dice.uniform(-50, 150))
        distance = dice.uniform(9000, 60000)
        parts.append(cloud(dice, f"cloud-{i + 1}", distance * math.sin(bearing), distance * math.cos(bearing),
                           dice.uniform(2200, 3300), dice.uniform(900, 2600), flat_bottom=True))
    for i, (x, y, heading) in enumerate(TURN_PATH):
        for j in range(4):
            bearing = math.radians(heading + dice.uniform(-20.0, 50.0))
            distance = dice.uniform(4500, 10000)
            x_cloud, y_cloud, base = x + distance * math.sin(bearing), y + distance * math.cos(bearing), dice.uniform(2500, 3300)
            if near_peaks.height(x_cloud, y_cloud) < base - 500.0:
                parts.append(cloud(dice, f"near-cloud-{i + 1}-{j + 1}", x_cloud, y_cloud, base, dice.uniform(450, 1000), flat_bottom=True))
    return scene(TURN_HEADER, parts)


def main():
    here = pathlib.Path(__file__).parent
    for name, text in {"takeoff": takeoff(), "turn": turn(), "village": village()}.items():
        (here / f"{name}.toml").write_text(text, encoding="utf-8")
        print(f"{name}.toml: {text.count('[[object]]')} objects")


if __name__ == "__main__":
    main()
