// SPDX-License-Identifier: Apache-2.0
#include "demo_pages.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <stdexcept>

namespace telehug {
namespace {

constexpr Duration look_interval = 200ms;

std::string link_to(ControlClient side) {
  const auto answer = side.ask({{"command", "open"}});
  if (!answer) throw std::runtime_error(answer.error().message);
  if (!answer->contains("url")) throw std::runtime_error("no page: " + answer->value("error", ""));
  return answer->at("url").get<std::string>();
}

}  // namespace

void run_for_pages(DemoWorld& world, Signals& signals) {
  world.start_active();
  fmt::print("\nOpen these in a browser on this PC, within a minute; each link works once:\n\n");
  fmt::print("  the parent's page   {}\n", link_to(world.connect_to_active()));
  fmt::print("  the wearer's page   {}\n\n", link_to(world.connect_to_passive()));
  fmt::print("For other links: build/release/bin/telehug open --print --socket {}/SIDE.sock (active or passive).\n",
             world.folder().string());
  fmt::print("It runs until you press Ctrl-C.\n");
  std::fflush(stdout);
  while (!signals.wait(look_interval))
    world.check_all_run();
}

}  // namespace telehug
