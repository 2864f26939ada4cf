// SPDX-License-Identifier: Apache-2.0
//
// From facts to findings, one function a subject: no device, file or clock is looked at here.
#pragma once

#include <string>
#include <vector>

#include "ctl/doctor/facts.hpp"

namespace telehug {

enum class Level { ok, warn, fail };

struct Finding {
  std::string check;  // its name: "camera"
  Level level = Level::ok;
  std::string what;
  std::string fix;  // empty if ok
};

using Findings = std::vector<Finding>;

inline constexpr int newest_firmware = 3;  // held to the firmware's by a test

[[nodiscard]] Findings check_config(const DoctorFacts& facts);
[[nodiscard]] Findings check_camera(const DoctorFacts& facts);
[[nodiscard]] Findings check_light(const DoctorFacts& facts);
[[nodiscard]] Findings check_monitor(const DoctorFacts& facts);
[[nodiscard]] Findings check_calibration(const DoctorFacts& facts);
[[nodiscard]] Findings check_session(const DoctorFacts& facts);
[[nodiscard]] Findings check_jacket(const DoctorFacts& facts);
[[nodiscard]] Findings check_serial(const DoctorFacts& facts);
[[nodiscard]] Findings check_bootloader(const DoctorFacts& facts);
[[nodiscard]] Findings check_bluetooth(const DoctorFacts& facts);
[[nodiscard]] Findings check_kernel(const DoctorFacts& facts);
[[nodiscard]] Findings check_clock(const DoctorFacts& facts);
[[nodiscard]] Findings check_ports(const DoctorFacts& facts);
[[nodiscard]] Findings check_firewall(const DoctorFacts& facts);
[[nodiscard]] Findings check_peers(const DoctorFacts& facts);
[[nodiscard]] Findings check_pairs(const DoctorFacts& facts);
[[nodiscard]] Findings check_state_folder(const DoctorFacts& facts);
[[nodiscard]] Findings check_disk(const DoctorFacts& facts);
[[nodiscard]] Findings check_units(const DoctorFacts& facts);
[[nodiscard]] Findings check_daemons(const DoctorFacts& facts);

[[nodiscard]] Findings all_checks(const DoctorFacts& facts);

// --- what several of them ask ---

[[nodiscard]] const SideFacts* find_side(const DoctorFacts& facts, Side side);
// Does its daemon answer?
[[nodiscard]] bool talks(const DoctorFacts& facts, Side side);

}  // namespace telehug
