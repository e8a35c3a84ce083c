#include "config/toml_section.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace quadrig::config {
namespace {

std::string shortest(double number) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    return {text.data(), end};
}

std::string describe(const toml::node& node) {
    if (const auto* text = node.as_string()) return "the string \"" + excerpt(text->get()) + "\"";
    if (const auto* number = node.as_floating_point()) return shortest(number->get());
    if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
    if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
    if (const auto* array = node.as_array()) return "an array of " + std::to_string(array->size());
    return node.is_table() ? "a table" : "a date or time";
}

std::string with_index(const std::string& key, std::size_t index) { return key + "[" + std::to_string(index) + "]"; }

std::string count_words(std::size_t least, std::size_t most) {
    return least == most ? std::to_string(least) : std::to_string(least) + ".." + std::to_string(most);
}

std::string list_of(KnownKeys known) {
    std::string list;
    for (const std::string_view name : known) list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
}

/// Parts that a key may have, as a.b.c has three. toml++ 3.3 recurses over them without a limit of its own.
constexpr int kMostKeyParts = 32;

/// Where the string that begins at `at` has ended.
std::size_t end_of_string(std::string_view text, std::size_t at) {
    const char quote = text[at];
    const bool long_one = text.substr(at, 3) == std::string(3, quote);
    const std::string end(long_one ? 3 : 1, quote);
    for (at += end.size(); at < text.size() && (long_one || text[at] != '\n'); ++at) {
        if (quote == '"' && text[at] == '\\')
            ++at;
        else if (text.substr(at, end.size()) == end)
            return std::min(text.find_first_not_of(quote, at), text.size());
    }
    return at;
}

/// The line of the first key that has more parts; 0 where none has.
std::size_t line_of_too_long_a_key(std::string_view text) {
    constexpr std::string_view kBetweenKeys = "\n=,[]{}";
    int parts = 1;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '"' || c == '\'')
            at = end_of_string(text, at) - 1;
        else if (c == '#')
            at = std::min(text.find('\n', at), text.size()) - 1;
        else if (kBetweenKeys.find(c) != std::string_view::npos)
            parts = 1;
        else if (c == '.' && ++parts > kMostKeyParts)
            return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + at, '\n'));
    }
    return 0;
}

/// A line of a text, counted from 1, without the blanks about it.
std::string_view line_of(std::string_view text, std::size_t line) {
    for (; line > 1; --line) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    text = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    return text.substr(0, text.find_last_not_of(" \t\r") + 1);
}

}  // namespace

toml::table parse_toml_file(const std::filesystem::path& file) { return parse_toml_text(file, read_text_file(file)); }

toml::table parse_toml_text(const std::filesystem::path& file, std::string_view text) {
    if (const std::size_t line = line_of_too_long_a_key(text))
        throw FileError(file, line, "",
                        "expected keys of at most " + std::to_string(kMostKeyParts) + " parts, found a longer one");
    try {
        return toml::parse(text, file.string());
    } catch (const toml::parse_error& error) {
        // The line says which key it is: a number beyond a double's range, 1e400, is none to the parser.
        const std::size_t line = error.source().begin.line;
        throw FileError(file, line, "",
                        "not TOML: " + std::string(error.description()) + ", in: " + excerpt(line_of(text, line)));
    }
}

TomlSection::TomlSection(const std::filesystem::path& file, const toml::table& table, std::string key, KnownKeys known)
    : file_(&file), table_(&table), key_(std::move(key)) {
    for (const auto& [name, node] : table) {
        if (std::find(known.begin(), known.end(), name.str()) == known.end()) {
            throw FileError(file, name.source().begin.line, key_of(name.str()),
                            "expected one of " + list_of(known) + ", found an unknown key");
        }
    }
}

std::string TomlSection::key_of(std::string_view name) const {
    return key_.empty() ? std::string(name) : key_ + "." + std::string(name);
}

const toml::node& TomlSection::required(std::string_view name) const {
    const toml::node* node = table_->get(name);
    if (node == nullptr) throw FileError(*file_, line(), key_of(name), "expected this key, found none");
    return *node;
}

void TomlSection::refuse(const toml::node& node, const std::string& key, std::string_view expected) const {
    throw FileError(*file_, node.source().begin.line, key,
                    "expected " + std::string(expected) + ", found " + describe(node));
}

void TomlSection::refuse(std::string_view name, const std::string& expected, const std::string& found) const {
    throw FileError(*file_, required(name).source().begin.line, key_of(name),
                    "expected " + expected + ", found " + found);
}

void TomlSection::refuse(std::string_view name, std::size_t index, const std::string& expected,
                         const std::string& found) const {
    const toml::array* array = required(name).as_array();
    const toml::node* element = array != nullptr ? array->get(index) : nullptr;
    const std::size_t at = element != nullptr ? element->source().begin.line : line();
    throw FileError(*file_, at, with_index(key_of(name), index), "expected " + expected + ", found " + found);
}

void TomlSection::refuse(const std::string& complaint) const { throw FileError(*file_, line(), key_, complaint); }

double TomlSection::number_at(const toml::node& node, const std::string& key, const NumberRule& rule) const {
    std::optional<double> number;
    if (node.is_floating_point()) number = node.as_floating_point()->get();
    if (node.is_integer()) number = static_cast<double>(node.as_integer()->get());
    if (!number || !std::isfinite(*number) || !rule.holds(*number)) refuse(node, key, rule.expected);
    return *number;
}

std::vector<double> TomlSection::numbers_at(const toml::node& node, const std::string& key, const NumberRule& rule,
                                            std::size_t least, std::size_t most) const {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() < least || array->size() > most) {
        refuse(node, key, "an array of " + count_words(least, most) + " numbers");
    }
    std::vector<double> numbers;
    numbers.reserve(array->size());
    for (const toml::node& element : *array) {
        numbers.push_back(number_at(element, with_index(key, numbers.size()), rule));
    }
    return numbers;
}

double TomlSection::number(std::string_view name, const NumberRule& rule) const {
    return number_at(required(name), key_of(name), rule);
}

bool TomlSection::flag_or(std::string_view name, bool absent) const {
    if (!has(name)) return absent;
    const toml::node& node = required(name);
    if (!node.is_boolean()) refuse(node, key_of(name), "true or false");
    return node.as_boolean()->get();
}

double TomlSection::number_or(std::string_view name, const NumberRule& rule, double absent) const {
    return has(name) ? number(name, rule) : absent;
}

std::vector<double> TomlSection::numbers(std::string_view name, const NumberRule& rule, std::size_t least,
                                         std::size_t most) const {
    return numbers_at(required(name), key_of(name), rule, least, most);
}

glm::dvec2 TomlSection::pair(std::string_view name, const NumberRule& rule) const {
    const std::vector<double> values = numbers(name, rule, 2, 2);
    return {values[0], values[1]};
}

glm::dvec3 TomlSection::triple(std::string_view name, const NumberRule& rule) const {
    const std::vector<double> values = numbers(name, rule, 3, 3);
    return {values[0], values[1], values[2]};
}

std::vector<std::vector<double>> TomlSection::rows(std::string_view name, const NumberRule& rule, std::size_t width,
                                                   std::size_t most) const {
    if (!has(name)) return {};
    const toml::node& node = required(name);
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() > most) {
        refuse(node, key_of(name),
               "an array of at most " + std::to_string(most) + " arrays of " + std::to_string(width) + " numbers");
    }
    std::vector<std::vector<double>> rows;
    rows.reserve(array->size());
    for (const toml::node& element : *array) {
        rows.push_back(numbers_at(element, with_index(key_of(name), rows.size()), rule, width, width));
    }
    return rows;
}

std::string TomlSection::text(std::string_view name) const {
    const toml::node& node = required(name);
    const auto* text = node.as_string();
    if (text == nullptr || text->get().empty()) refuse(node, key_of(name), "a string of at least one character");
    return text->get();
}

std::optional<std::string> TomlSection::optional_text(std::string_view name) const {
    return has(name) ? std::optional(text(name)) : std::nullopt;
}

std::vector<std::string> TomlSection::texts(std::string_view name) const {
    if (!has(name)) return {};
    const toml::array* array = required(name).as_array();
    if (array == nullptr) refuse(required(name), key_of(name), "an array of strings");
    std::vector<std::string> texts;
    texts.reserve(array->size());
    for (const toml::node& element : *array) {
        const auto* text = element.as_string();
        if (text == nullptr || text->get().empty()) {
            refuse(element, with_index(key_of(name), texts.size()), "a string of at least one character");
        }
        texts.push_back(text->get());
    }
    return texts;
}

TomlSection TomlSection::table(std::string_view name, KnownKeys known) const {
    const toml::node& node = required(name);
    const toml::table* table = node.as_table();
    if (table == nullptr) refuse(node, key_of(name), "a table");
    return {*file_, *table, key_of(name), known};
}

std::optional<TomlSection> TomlSection::optional_table(std::string_view name, KnownKeys known) const {
    return has(name) ? std::optional(table(name, known)) : std::nullopt;
}

std::vector<TomlSection> TomlSection::tables(std::string_view name, KnownKeys known) const {
    if (!has(name)) return {};
    const toml::node& node = required(name);
    const toml::array* array = node.as_array();
    if (array == nullptr) refuse(node, key_of(name), "an array of tables, [[" + std::string(name) + "]]");
    std::vector<TomlSection> sections;
    sections.reserve(array->size());
    for (const toml::node& element : *array) {
        const std::string key = with_index(key_of(name), sections.size());
        const toml::table* table = element.as_table();
        if (table == nullptr) refuse(element, key, "a table");
        sections.emplace_back(*file_, *table, key, known);
    }
    return sections;
}

}  // namespace quadrig::config
