/// A table of a TOML file as a reader of settings wants it: every key is known, every value has its type and range, and
/// whatever is not so is refused with file, line and key.
#pragma once

#include <toml++/toml.h>
#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/file_error.h"

namespace quadrig::config {

/// What a number has to be, in words and as a test. The test sees finite numbers only.
struct NumberRule {
    std::string_view expected;
    bool (*holds)(double);
};
inline constexpr NumberRule kFraction{"a number in 0..1", [](double x) { return x >= 0.0 && x <= 1.0; }};
inline constexpr NumberRule kPositive{"a number above 0", [](double x) { return x > 0.0; }};

/// Keys that a table may have.
using KnownKeys = std::initializer_list<std::string_view>;

/// The document in a file. Throws FileError with the line of a syntax error.
toml::table parse_toml_file(const std::filesystem::path& file);
/// The same of a text; `file` is what messages call it.
toml::table parse_toml_text(const std::filesystem::path& file, std::string_view text);

/// One table of a document. It refers to the document and to the file's name, which must outlive it. Integers are taken
/// where numbers are expected. Indices in keys count from 0. Every member throws FileError.
class TomlSection {
  public:
    /// `key` is the table's own, empty for the document. A key that is not among `known` is refused here.
    TomlSection(const std::filesystem::path& file, const toml::table& table, std::string key, KnownKeys known);

    [[nodiscard]] bool has(std::string_view name) const { return table_->contains(name); }

    [[nodiscard]] double number(std::string_view name, const NumberRule& rule) const;
    [[nodiscard]] bool flag_or(std::string_view name, bool absent) const;
    [[nodiscard]] double number_or(std::string_view name, const NumberRule& rule, double absent) const;
    /// An array of `least` to `most` numbers.
    [[nodiscard]] std::vector<double> numbers(std::string_view name, const NumberRule& rule, std::size_t least,
                                              std::size_t most) const;
    [[nodiscard]] glm::dvec2 pair(std::string_view name, const NumberRule& rule) const;
    [[nodiscard]] glm::dvec3 triple(std::string_view name, const NumberRule& rule) const;
    /// An array of arrays of `width` numbers, empty where the key is absent.
    [[nodiscard]] std::vector<std::vector<double>> rows(std::string_view name, const NumberRule& rule,
                                                        std::size_t width, std::size_t most) const;
    /// A string of at least one character.
    [[nodiscard]] std::string text(std::string_view name) const;
    [[nodiscard]] std::optional<std::string> optional_text(std::string_view name) const;
    /// An array of strings of at least one character each, empty where the key is absent.
    [[nodiscard]] std::vector<std::string> texts(std::string_view name) const;
    [[nodiscard]] TomlSection table(std::string_view name, KnownKeys known) const;
    [[nodiscard]] std::optional<TomlSection> optional_table(std::string_view name, KnownKeys known) const;
    /// An array of tables ([[name]]), empty where the key is absent.
    [[nodiscard]] std::vector<TomlSection> tables(std::string_view name, KnownKeys known) const;

    /// Refuses the value of `name` or its element `index`, saying what was expected and what was found instead.
    [[noreturn]] void refuse(std::string_view name, const std::string& expected, const std::string& found) const;
    [[noreturn]] void refuse(std::string_view name, std::size_t index, const std::string& expected,
                             const std::string& found) const;
    /// Refuses the whole table.
    [[noreturn]] void refuse(const std::string& complaint) const;

    [[nodiscard]] const std::string& key() const { return key_; }
    [[nodiscard]] std::size_t line() const { return table_->source().begin.line; }

  private:
    [[nodiscard]] std::string key_of(std::string_view name) const;
    [[nodiscard]] const toml::node& required(std::string_view name) const;
    [[noreturn]] void refuse(const toml::node& node, const std::string& key, std::string_view expected) const;
    [[nodiscard]] double number_at(const toml::node& node, const std::string& key, const NumberRule& rule) const;
    [[nodiscard]] std::vector<double> numbers_at(const toml::node& node, const std::string& key, const NumberRule& rule,
                                                 std::size_t least, std::size_t most) const;

    const std::filesystem::path* file_;
    const toml::table* table_;
    std::string key_;
};

}  // namespace quadrig::config
