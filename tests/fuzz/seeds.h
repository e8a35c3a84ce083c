/// What fuzzing starts from: sound inputs, made by the encoders and out of the files of this repository.
#pragma once

#include <string>
#include <vector>

#include "tests/fuzz/messages.h"

namespace quadrig::fuzz {

struct Seed {
    std::string target, name;
    Bytes bytes;
};

/// A few for every target; the same ones every time.
std::vector<Seed> seeds();

}  // namespace quadrig::fuzz
