// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "bench/homes/link_figures.hpp"
#include "bench/homes/touch_ways.hpp"
#include "doubles/child_program.hpp"
#include "doubles/temporary_folder.hpp"
#include "netlab/two_homes.hpp"

namespace telehug {

struct Network {
  std::string name;
  std::optional<WayFaults> faults;  // of each direction between the homes; none: both on one PC, over its loopback
};

struct ExchangePlan {
  Way way = Way::secured;
  int rate_hz = 120;
  Duration settle{};  // from the first arrival on, not counted
  Duration lasts{};
};

struct Exchange {
  LinkFigures figures;
  // Of one core, while it lasted.
  double sender_cpu = 0;
  double receiver_cpu = 0;  // with the broker
};

// Starts sender and receiver as processes of their own, lets one send to the other, and ends them.
class Exchanges {
 public:
  // Throws std::system_error where namespaces are not permitted.
  explicit Exchanges(std::uint32_t seed);

  // Throws std::runtime_error if nothing arrives.
  [[nodiscard]] Exchange run(const Network& network, const ExchangePlan& plan);

 private:
  struct Programs {
    std::unique_ptr<ChildProgram> broker;  // only for MQTT
    std::unique_ptr<ChildProgram> receiver;
    std::unique_ptr<ChildProgram> sender;
  };
  [[nodiscard]] Programs start(const Meeting& meeting, const ExchangePlan& plan,
                               const std::filesystem::path& log) const;

  TwoHomes homes_;
  TemporaryFolder folder_;
  std::mt19937 random_;
  int count_ = 0;
};

}  // namespace telehug
