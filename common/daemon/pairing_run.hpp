// SPDX-License-Identifier: Apache-2.0
//
// A pairing as `telehug pair invite` or `accept` makes it: that program, run by a daemon, in a thread of its own.
#pragma once

#include <atomic>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace telehug {

class PairingRun {
 public:
  struct Handlers {
    std::function<void(const nlohmann::json&)> told;          // each object that the program prints
    std::function<void(const std::string& problem)> is_over;  // last; empty: it ended well
  };

  // `command`: the program's path and its words. Handlers are called in the run's own thread.
  PairingRun(std::vector<std::string> command, Handlers handlers);
  ~PairingRun();  // ends the program and waits for it, 2 s and a bit at most
  PairingRun(const PairingRun&) = delete;
  PairingRun& operator=(const PairingRun&) = delete;

  // The program is asked to end, and then is over with a problem. Does not wait.
  void cancel() noexcept { cancelled_ = true; }

 private:
  void run(std::vector<std::string> command);

  const Handlers handlers_;
  std::atomic<bool> cancelled_ = false;
  std::thread thread_;
};

}  // namespace telehug
