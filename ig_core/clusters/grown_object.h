/// One object of a cluster: its template, changed at random, set down at a place.
#pragma once

#include "ig_core/clusters/abutting.h"
#include "ig_core/clusters/cluster.h"
#include "ig_core/clusters/dice.h"

namespace quadrig::clusters {

struct Perturbation {
    double size = 1.0;
    glm::dvec3 shape{1.0};   ///< factors of the semi-axes; a hill's slope takes the first
    glm::dvec3 colour{1.0};  ///< factors
    double altitude = 0.0;   ///< m
    Attitude turn;
};

/// Always takes as many numbers from the dice, whatever may vary: to change one variation changes nothing else.
Perturbation perturbation(const Variation& variation, Dice& dice);

struct GrownObject {
    Object object;
    CentredQuadric quadric;  ///< of use for objects whose shape and attitude are the template's
};

/// An ellipsoid's planes are stretched and turned with it about its centre; a hill's move with its foot and grow with
/// it. Lengths and coordinates are held to what a scene file may have. The template must be an ellipsoid or a hill.
GrownObject grown_object(const Object& from, const glm::dvec3& foot, const Perturbation& change);

}  // namespace quadrig::clusters
