// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "gpio/emergency_stop.hpp"
#include "gpio/jacket_situation.hpp"
#include "gpio/panel_lines.hpp"

namespace telehug {

// What the panel has done with; each is called on the panel's thread (the first time in start()).
struct PanelCalls {
  // Stops everything, and lets nothing resume until release(). Both one sentence's worth of words: why, and why nothing
  // resumes.
  std::function<void(const std::string& reason, const std::string& obstacle)> hold;
  std::function<void()> release;
  std::function<void()> resume;
  std::function<bool()> stopped;
  std::function<void()> hug;  // the wearer hugs back; must not wait
};

struct PanelStatus {
  bool stop_button = false;  // is there one?
  bool stop_pressed = false;
  bool power_line = false;
  bool power = false;                 // driven
  std::vector<std::string> problems;  // sentences
};

// Buttons, power line and status light of the jacket, on a thread of their own: nothing that takes its time keeps a
// stop waiting, and nothing here keeps a drive waiting.
class Panel {
 public:
  // Each line is looked at and set at least this often.
  static constexpr Duration round = 20ms;
  // A situation that is older than that is nobody's: whoever told it hangs.
  static constexpr Duration oldest_situation = 250ms;

  // `clock` outlives it.
  Panel(PanelLines lines, const PanelOptions& options, PanelCalls calls, const Clock& clock);
  // Takes the supply from the motors and puts out the light.
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  // Serves the lines once, so that a button which is pressed now has stopped everything when this returns; then goes on
  // with that on a thread.
  void start();
  void stop();

  // From the drive thread, as often as it likes; never waits. `problem` is the panel's own.
  void tell(const JacketSituation& situation, Timestamp now) noexcept;

  [[nodiscard]] PanelStatus status() const;

  // One round: what the buttons say, then what outputs follow from it. What start() goes on with; for tests.
  void serve(Timestamp now);

 private:
  void run();
  void wait(Timestamp now);
  void serve_stop_button(Timestamp now);
  void serve_hug_button(Timestamp now);
  void serve_outputs(Timestamp now);
  // For good: whoever has mended it starts the program again.
  void lose_stop_button(const Error& why);
  void lose_power(const Error& why);
  void note(const char* what, const Error& why);
  [[nodiscard]] JacketSituation situation(Timestamp now) const;

  PanelLines lines_;
  const PanelCalls calls_;
  const Clock& clock_;
  std::optional<EmergencyStop> emergency_stop_;
  bool held_ = false;  // by us
  bool power_lost_ = false;
  std::optional<bool> power_;
  std::optional<bool> light_;

  std::atomic<std::uint8_t> told_{0};  // bits of JacketSituation
  std::atomic<std::int64_t> told_ns_{0};
  std::atomic<bool> ending_{false};
  mutable std::mutex mutex_;
  PanelStatus status_;  // guarded by it
  std::thread thread_;
};

}  // namespace telehug
