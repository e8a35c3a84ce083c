/// libFuzzer's program: one target of all, chosen by --target=NAME.
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "tests/fuzz/targets.h"

namespace {

const quadrig::fuzz::Target* chosen = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    constexpr std::string_view kOption = "--target=";
    std::string_view name;
    for (int i = 1; i < *count; ++i)
        if (const std::string_view argument((*arguments)[i]); argument.starts_with(kOption))
            name = argument.substr(kOption.size());
    std::string names;
    for (const auto& target : quadrig::fuzz::targets()) {
        if (target.name == name) chosen = &target;
        names += ' ' + std::string(target.name);
    }
    if (chosen != nullptr) return 0;
    std::cerr << "quadrig_fuzz: --target= one of" << names << '\n';
    std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto input = std::as_bytes(std::span(data, size));
    if (input.size() <= chosen->most_bytes) chosen->read(input);
    return 0;
}
