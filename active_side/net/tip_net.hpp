// SPDX-License-Identifier: Apache-2.0
//
// Where exactly in a patch about a fingertip the finger touches, whether it does, and how sure that is.
#pragma once

#include <memory>

namespace telehug {

// What is seen in one patch.
struct TipLook {
  double column = 0;  // of the contact's middle (hovering: of the finger's foremost point) in the patch, from 0
  double row = 0;
  double present_logit = 0;   // log odds that a finger ends here
  double touches_logit = 0;   // that it touches
  double hover_mm = 0;        // how far it seems to be from the screen
  double width = 0;           // of the finger, in patch columns
  double spread_columns = 0;  // mean absolute errors to be expected
  double spread_rows = 0;
};

class TipNet {
 public:
  static constexpr int rows = 80;
  static constexpr int columns = 64;
  // A patch is best laid so that the tip is about here.
  static constexpr int tip_row = 44;
  static constexpr int tip_column = 32;

  TipNet();
  TipNet(TipNet&&) noexcept;
  TipNet& operator=(TipNet&&) noexcept;
  ~TipNet();

  // Where to write the patch before look(): rows by columns by 3 (see finger/tip_patch.hpp).
  [[nodiscard]] float* patch() noexcept;

  // (u, v): where in the picture the tip is expected, from its centre, in halves of its width. Allocates nothing.
  TipLook look(double u, double v);

 private:
  struct Layers;
  std::unique_ptr<Layers> layers_;
};

}  // namespace telehug
