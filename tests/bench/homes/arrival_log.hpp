// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace telehug {

// What a receiver writes down: times are CLOCK_MONOTONIC, which all namespaces of a PC share.
struct Arrival {
  enum class Of : std::uint64_t { state, transition };  // as wide as the rest: no gaps in the file

  Of of = Of::state;
  std::int64_t arrived_ns = 0;
  std::uint64_t sequence = 0;  // of the event; of a down or an up that was not known before: the event it was new in
  std::int64_t sent_ns = 0;    // of a state
};

// A file that is whole whenever its writer is killed.
class ArrivalLog {
 public:
  explicit ArrivalLog(const std::filesystem::path& file);
  ~ArrivalLog();
  ArrivalLog(const ArrivalLog&) = delete;
  ArrivalLog& operator=(const ArrivalLog&) = delete;

  void add(const Arrival& arrival) const;

 private:
  int descriptor_ = -1;
};

// In the order of their arrival; none if there is no file yet.
[[nodiscard]] std::vector<Arrival> arrivals_in(const std::filesystem::path& file);

}  // namespace telehug
