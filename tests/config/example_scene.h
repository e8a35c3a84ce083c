/// The example of config/README.md, with every key that a scene file has.
#pragma once

#include <string_view>

namespace quadrig::tests {

inline constexpr std::string_view kExampleScene = R"([scene]
name = "one-tree"
origin = { latitude = 47.2602, longitude = 11.3439, altitude = 581.0 }   # WGS-84 degrees, metres
[sun]
azimuth = 140.0                     # degrees clockwise from north
elevation = 40.0
ambient = 0.3
[sky]
horizon = [0.62, 0.72, 0.82]        # linear light
zenith  = [0.18, 0.34, 0.62]
[haze]
visibility = 20000.0                # m; absent = no haze
colour = [0.62, 0.72, 0.82]
[ground]
colour = [0.25, 0.33, 0.14]
texture = "grass"
texture_weight = 0.6
[[cloud_deck]]
altitude = 2000.0
colour = [1.0, 1.0, 1.0]
texture = "overcast"
texture_weight = 0.3
translucence = { threshold = 0.30, limb_threshold = 0.30, softness = 0.2 }
[[texture]]
name = "grass"
coefficients = [1.0, 0.707, 0.5]
frequencies  = [0.05, 0.11, 0.21]   # rad/m
phases       = [0.3, 1.9, 4.0]
vertical = 0.0                      # vertical variation u
drift = [0.0, 0.0]                  # m/s
[[texture]]
name = "overcast"
coefficients = [1.0, 0.5]
frequencies  = [0.001, 0.0022]
phases       = [0.3, 1.9]
drift = [3.0, -4.0]
[[texture]]
name = "leaves"
coefficients = [1.0]
frequencies  = [0.9]
phases       = [0.3]
vertical = 0.75
[[object]]
name = "tree-1"
ellipsoid = { centre = [0.0, 100.0, 6.0], semi_axes = [4.0, 4.0, 6.0], heading = 0.0 }
planes = [[0.0, 0.0, 1.0, -1.0]]    # B1..B4, kept where positive
colour = [0.1, 0.25, 0.05]
texture = "leaves"
texture_weight = 0.7
translucence = { threshold = 0.12, limb_threshold = 0.45, softness = 0.15 }
[[object]]
name = "hill-1"
hill = { apex = [500.0, 900.0, 120.0], radius_of_curvature = 200.0, slope = 0.5 }   # lower sheet of a two-sheet hyperboloid
planes = [[0.0, 0.0, 1.0, 0.0]]
colour = [0.3, 0.35, 0.2]
[[object]]
name = "anything"
quadric = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, -2.0, 0.0, 0.0, -3.0]  # Q1 X2, Q2 Y2, Q3 Z2, Q4 XY, Q5 YZ, Q6 XZ, Q7 X, Q8 Y, Q9 Z, Q0
colour = [1.0, 1.0, 1.0]
)";

}  // namespace quadrig::tests
