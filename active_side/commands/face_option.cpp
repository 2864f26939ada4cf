// SPDX-License-Identifier: Apache-2.0
#include "commands/face_option.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <utility>

#include "face/make_face_finder.hpp"

namespace telehug {

void add_face_option(CLI::App& command, std::string& name) {
  command.add_option("--face", name, "Which finder looks for faces; haar is the thesis'")
      ->check(CLI::IsMember({"blaze", "haar"}))
      ->capture_default_str();
}

Result<std::unique_ptr<FaceFinder>> chosen_face_finder(const std::string& name) {
  auto chosen = make_face_finder(name);
  if (!chosen) return chosen.error();
  if (!chosen->note.empty()) fmt::print(stderr, "telehug-active: {}\n", chosen->note);
  return std::move(chosen->finder);
}

}  // namespace telehug
