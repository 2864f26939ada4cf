// SPDX-License-Identifier: Apache-2.0
//
// A heating pad on the wearer's skin, its thermistor and its thermal fuse, as a model of two lumps: the pad, warmed by
// its heater and cooled by skin and air, and the sensor, which follows the pad.
#pragma once

#include <cstdint>
#include <optional>

namespace telehug {

struct PatchParameters {
  double heater_w = 2;     // 5 V on 12.5 ohm
  double pad_j_per_k = 8;  // some 6 g of carbon fibre pad and textile
  double to_skin_w_per_k = 0.09;
  double to_air_w_per_k = 0.03;  // through the jacket
  double skin_celsius = 33;
  double air_celsius = 23;
  double sensor_lag_s = 1;
  double detached_lag_s = 5;  // of a sensor that hangs in the air
  double fuse_celsius = 43;   // opens for good
};

// What breaks.
enum class HeaterBreak : std::uint8_t {
  open,         // the thermistor's cable is cut
  shorted,      // its wires touch
  detached,     // it has come off the pad and hangs in the air
  runaway,      // the heater's own transistor conducts all the time
  overvoltage,  // the heater gets 14 V instead of 5
};

class HeatedPatch {
 public:
  explicit HeatedPatch(const PatchParameters& parameters = {});

  // `heated`: whether the heater has power in this time.
  void advance(double seconds, bool heated);
  void break_it(HeaterBreak what);

  [[nodiscard]] double pad_celsius() const { return pad_celsius_; }
  [[nodiscard]] double sensor_celsius() const { return sensor_celsius_; }
  [[nodiscard]] bool runs_away() const { return runs_away_; }
  [[nodiscard]] bool fuse_has_opened() const { return fuse_open_; }
  // At the divider of 10 kOhm to a supply of `supply_mv`.
  [[nodiscard]] unsigned thermistor_mv(unsigned supply_mv) const;

  // The wearer, the weather.
  PatchParameters parameters;

 private:
  double pad_celsius_;
  double sensor_celsius_;
  std::optional<HeaterBreak> sensor_break_;
  bool runs_away_ = false;
  bool overvoltage_ = false;
  bool fuse_open_ = false;
};

}  // namespace telehug
