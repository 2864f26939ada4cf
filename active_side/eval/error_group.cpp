// SPDX-License-Identifier: Apache-2.0
#include "eval/error_group.hpp"

#include <cmath>
#include <string_view>

namespace telehug {
namespace {

// The truth of a frame without a hand names no tone.
std::vector<std::string> looks(const std::string& tone, const std::string& screen) {
  std::vector<std::string> groups;
  if (!tone.empty()) groups.push_back("tone " + tone);
  if (!screen.empty()) groups.push_back("screen " + screen);
  return groups;
}

template <typename Scored>
void add_each(ErrorGroups& groups, const std::vector<Scored>& all, const std::vector<std::string>& common) {
  for (const Scored& one : all) {
    for (const std::string& name : groups_of(one))
      groups[name].add(one);
    for (const std::string& name : common)
      groups[name].add(one);
  }
}

}  // namespace

void ErrorGroup::add(const ScoredTouch& touch) {
  ++touches;
  if (!touch.found) return;
  ++found;
  all_vertical_mm.push_back(std::abs(touch.vertical_error_mm));
  all_horizontal_mm.push_back(std::abs(touch.horizontal_error_mm));
  if (!touch.near()) return;
  vertical_mm.push_back(all_vertical_mm.back());
  horizontal_mm.push_back(all_horizontal_mm.back());
}

void ErrorGroup::add(const ScoredRest& rest) {
  ++rests;
  if (!rest.false_touches.empty()) ++rests_touched;
}

std::vector<std::string> groups_of(const ScoredTouch& touch) {
  const auto noted = [&](std::string_view word) { return touch.notes.find(word) != std::string::npos; };
  std::vector<std::string> groups = looks(touch.tone, touch.screen);
  groups.emplace_back(noted("long nail") ? "nail long" : "nail short");
  groups.emplace_back(noted("polish") ? "polish yes" : "polish no");
  groups.emplace_back(noted("ring") ? "ring yes" : "ring no");
  groups.emplace_back(noted("glove") ? "glove yes" : "glove no");
  groups.emplace_back(noted("two hands") ? "hands two" : noted("two fingers") ? "hands two fingers" : "hands one");
  return groups;
}

std::vector<std::string> groups_of(const ScoredRest& rest) {
  return looks(rest.tone, rest.screen);
}

ErrorGroup whole(const TouchScore& score) {
  ErrorGroup all;
  for (const ScoredTouch& touch : score.touches)
    all.add(touch);
  for (const ScoredRest& rest : score.rests)
    all.add(rest);
  return all;
}

void add(ErrorGroups& groups, const TouchScore& score, const std::vector<std::string>& common) {
  add_each(groups, score.touches, common);
  add_each(groups, score.rests, common);
}

ErrorGroups groups_that_differ(const ErrorGroups& groups) {
  const auto kind_of = [](const std::string& name) { return name.substr(0, name.find(' ')); };
  std::map<std::string, std::size_t> members;
  for (const auto& [name, group] : groups)
    ++members[kind_of(name)];
  ErrorGroups differing = groups;
  std::erase_if(differing, [&](const auto& entry) { return members[kind_of(entry.first)] < 2; });
  return differing;
}

}  // namespace telehug
