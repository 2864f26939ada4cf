// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "common/clock.hpp"
#include "jacket/drive.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

// The last step for one actuator: from how strong it shall be felt to what it is told, which takes account of what a
// motor is. Remembers what it was told, so that only what is new goes out. Times do not go back.
class DriveShaper {
 public:
  explicit DriveShaper(const Actuator& actuator) : actuator_(&actuator) {}

  // How strong (0..1) it shall be from now on, and until when; 0: off.
  void want(double strength, Timestamp end, Timestamp now);

  [[nodiscard]] bool on() const noexcept { return wanted_.strength > 0; }
  // What it has to be told; nothing if it is off and knows it.
  [[nodiscard]] std::optional<Drive> state(Timestamp now) const;

  enum class News {
    none,
    slight,  // a little stronger or weaker, or longer: it may wait
    urgent,  // on, off, or the end of a start
  };
  [[nodiscard]] News news(Timestamp now) const;

  void told(Timestamp now);
  // It is off, whatever it was told.
  void forget() noexcept;

 private:
  [[nodiscard]] bool runs(Timestamp now) const noexcept;

  const Actuator* actuator_;
  Drive wanted_;
  bool starts_ = false;  // the drive that is wanted is a kick
  Timestamp kick_ends_;
  Drive told_;
  bool told_start_ = false;
  std::optional<Timestamp> stopped_;  // not known: long ago
};

}  // namespace telehug
