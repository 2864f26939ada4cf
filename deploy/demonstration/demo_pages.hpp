// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "demo_world.hpp"
#include "service/signals.hpp"

namespace telehug {

// Starts the active side, tells where both sides' pages are, and lets everything run until a signal asks for the end.
// Throws std::runtime_error if a program ends by itself or tells no link.
void run_for_pages(DemoWorld& world, Signals& signals);

}  // namespace telehug
