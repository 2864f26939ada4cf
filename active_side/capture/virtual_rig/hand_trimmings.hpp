// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "capture/virtual_rig/hand_skeleton.hpp"

namespace telehug {

// A nail: a curved plate on the upper side of a finger's end that reaches nail_mm past it.
TriangleMesh nail(const FingerEnd& end, const HandLooks& looks);

// A gold ring around a limb.
TriangleMesh ring(const Limb& segment);

}  // namespace telehug
