// SPDX-License-Identifier: Apache-2.0
#include "config/key.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace telehug {
namespace {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

template <typename Number>
std::optional<Number> whole_text_as(std::string_view text) {
  Number number{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string wrong_type(const Key& key) {
  return fmt::format("{} must be {}", key.path(), type_name(key.target));
}

std::optional<std::string> outside(const Key& key, double number) {
  const auto* range = std::get_if<Range>(&key.limits);
  if (std::isfinite(number) && (range == nullptr || (number >= range->least && number <= range->most))) {
    return std::nullopt;
  }
  return fmt::format("{} is {}; it must be within {}{}{}", key.path(), number, limits_text(key.limits),
                     key.unit.empty() ? "" : " ", key.unit);
}

std::optional<std::string> assign_text(Key& key, std::string& target, const std::string& text) {
  if (text.find('\0') != std::string::npos) return fmt::format("{} must not contain a null byte", key.path());
  if (const auto* one_of = std::get_if<OneOf>(&key.limits)) {
    if (std::find(one_of->choices.begin(), one_of->choices.end(), text) == one_of->choices.end()) {
      return fmt::format("{} is \"{}\"; it must be one of {}", key.path(), text, limits_text(key.limits));
    }
  }
  if (const auto* check = std::get_if<TextCheck>(&key.limits)) {
    if (const auto problem = (*check)(text)) return fmt::format("{}: {}", key.path(), *problem);
  }
  target = text;
  return std::nullopt;
}

std::optional<std::string> assign_whole(Key& key, int& target, const Value& value) {
  const auto* number = std::get_if<long long>(&value);
  if (number == nullptr) return wrong_type(key);
  if (auto problem = outside(key, static_cast<double>(*number))) return problem;
  if (!std::in_range<int>(*number)) return fmt::format("{} is too large", key.path());
  target = static_cast<int>(*number);
  return std::nullopt;
}

std::optional<std::string> assign_real(Key& key, double& target, const Value& value) {
  double number = 0;
  if (const auto* real = std::get_if<double>(&value)) {
    number = *real;
  } else if (const auto* whole = std::get_if<long long>(&value)) {
    number = static_cast<double>(*whole);
  } else {
    return wrong_type(key);
  }
  if (auto problem = outside(key, number)) return problem;
  target = number;
  return std::nullopt;
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == '\x7F') {
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
      continue;
    }
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

}  // namespace

std::string Key::path() const {
  return fmt::format("{}.{}", section, name);
}

std::optional<std::string> assign(Key& key, const Value& value) {
  return std::visit(Overloaded{
                        [&](std::string* target) -> std::optional<std::string> {
                          const auto* text = std::get_if<std::string>(&value);
                          return text == nullptr ? wrong_type(key) : assign_text(key, *target, *text);
                        },
                        [&](int* target) { return assign_whole(key, *target, value); },
                        [&](double* target) { return assign_real(key, *target, value); },
                        [&](bool* target) -> std::optional<std::string> {
                          const auto* flag = std::get_if<bool>(&value);
                          if (flag == nullptr) return wrong_type(key);
                          *target = *flag;
                          return std::nullopt;
                        },
                    },
                    key.target);
}

std::optional<Value> value_from_text(const Key& key, std::string_view text) {
  return std::visit(Overloaded{
                        [&](std::string*) -> std::optional<Value> { return std::string(text); },
                        [&](int*) -> std::optional<Value> { return whole_text_as<long long>(text); },
                        [&](double*) -> std::optional<Value> { return whole_text_as<double>(text); },
                        [&](bool*) -> std::optional<Value> {
                          if (text == "true") return true;
                          if (text == "false") return false;
                          return std::nullopt;
                        },
                    },
                    key.target);
}

std::string_view type_name(const Target& target) {
  return std::visit(Overloaded{
                        [](std::string*) { return std::string_view("a text"); },
                        [](int*) { return std::string_view("a whole number"); },
                        [](double*) { return std::string_view("a number"); },
                        [](bool*) { return std::string_view("true or false"); },
                    },
                    target);
}

std::string limits_text(const Limits& limits) {
  if (const auto* range = std::get_if<Range>(&limits)) return fmt::format("{} .. {}", range->least, range->most);
  if (const auto* one_of = std::get_if<OneOf>(&limits)) return fmt::format("{}", fmt::join(one_of->choices, " | "));
  return {};
}

std::string toml_text(const Target& target) {
  return std::visit(Overloaded{
                        [](const std::string* text) { return quoted(*text); },
                        [](const int* number) { return fmt::format("{}", *number); },
                        // TOML tells 1.0 from 1; a file that is read back must keep the type.
                        [](const double* number) {
                          const std::string text = fmt::format("{}", *number);
                          return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
                        },
                        [](const bool* flag) { return std::string(*flag ? "true" : "false"); },
                    },
                    target);
}

}  // namespace telehug
