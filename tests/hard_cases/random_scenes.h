/// Random scenes of solids of every kind, and random eyes that see them.
#pragma once

#include "ig_core/view.h"

namespace quadrig::test {

struct RandomScene {
    Scene scene;
    View view;
};

/// 1 to 200 objects with 0 to 16 planes each, from specks to ones that fill the picture or surround the eye, ahead of
/// an eye of any attitude; often on a ground plane, now and then far from the scene's origin. The same for the same
/// `trial` and seed.
RandomScene random_scene(int trial, int width, int height);

}  // namespace quadrig::test
