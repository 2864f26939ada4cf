// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/clock.hpp"
#include "common/result.hpp"
#include "common/units.hpp"
#include "touch/contact_state.hpp"

namespace telehug {

// Something on this PC (or, for TUIO, near it) that takes the touches besides the other side. One thread uses it.
class LocalTouchOutput {
 public:
  virtual ~LocalTouchOutput() = default;

  // Gets ready for touches on `screen`, whose sizes in mm are positive. The error says what to do about it.
  virtual Status open(const ScreenSize& screen) = 0;

  // Tells what touches now. Contacts that were told before and are missing or `up` are lifted: whoever skips a frame
  // loses no up. After an error it is to be closed.
  virtual Status send(const ContactStates& contacts, Timestamp time) = 0;

  // Lifts every contact and ends what open() began; idempotent.
  virtual void close() = 0;

  // What status calls it: "touchscreen", "TUIO 127.0.0.1:3333".
  [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace telehug
