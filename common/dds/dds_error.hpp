// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace telehug {

// DDS can't be set up on this PC; what() is a sentence.
class DdsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace telehug
