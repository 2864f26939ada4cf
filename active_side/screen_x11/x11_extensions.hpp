// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/result.hpp"
#include "screen_x11/x11_connection.hpp"

namespace telehug {

// A server must be told which version of an extension is spoken before it is used: DAMAGE, XFIXES, RANDR, Composite and
// SHAPE. Fails if it lacks one of them.
Status agree_on_x11_extensions(const X11Connection& connection);

}  // namespace telehug
