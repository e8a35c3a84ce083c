#include "tests/house/lone_headers.h"

#include <catch2/catch.hpp>

#include "tests/house/planted_tree.h"

using namespace quadrig::tests;

TEST_CASE("every header compiles alone") {
    const auto bad = headers_that_need_others(QUADRIG_SOURCE_DIR);
    for (const auto& header : bad) UNSCOPED_INFO(header.string());
    CHECK(bad.empty());
}

TEST_CASE("a header that needs another to be included first is found") {
    const PlantedTree tree;
    tree.plant("display/good.h", "#pragma once\n#include <vector>\nstruct Good { std::vector<int> numbers; };\n");
    tree.plant("display/uses_good.h", "#pragma once\n#include \"display/good.h\"\ninline Good good;\n");
    tree.plant("display/bad.h", "#pragma once\nstruct Bad { std::vector<int> numbers; };\n");
    tree.plant("display/first.h", "#pragma once\nstruct First { std::vector<int> numbers; };\n");
    tree.plant("display/first.cpp", "#include \"display/first.h\"\n#include <vector>\n");  // the build finds this one
    CHECK(headers_that_need_others(tree.root()) == std::vector<std::filesystem::path>{"display/bad.h"});
}
