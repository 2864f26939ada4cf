// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "local_touch/local_touch_output.hpp"

namespace telehug {

// What touches, at one time, on which screen.
struct LocalTouchFrame {
  ContactStates contacts;
  ScreenSize screen;
  Timestamp time;
};

struct LocalTouchState {
  std::string name;
  bool open = false;
  std::string problem;  // why it does not work and what to do; empty: it does, or nobody has touched yet
};

// Keeps outputs open and fed: one that fails is closed and tried again every 5 s, the others go on. With explicit time;
// one thread uses it.
class LocalTouchOutputs {
 public:
  static constexpr Duration retry_interval = 5s;
  // Without a frame for so long every contact is lifted: who should send them hangs.
  static constexpr Duration silence = 500ms;

  explicit LocalTouchOutputs(std::vector<std::unique_ptr<LocalTouchOutput>> outputs);

  // `frame`: the newest, or null if none came. Outputs open with the first frame whose screen has a size, and again
  // when the screen changes.
  void serve(const LocalTouchFrame* frame, Timestamp now);

  // Lifts everything and closes.
  void close();

  [[nodiscard]] std::vector<LocalTouchState> states() const;

 private:
  struct Output {
    std::unique_ptr<LocalTouchOutput> output;
    bool open = false;
    std::optional<Timestamp> tried;
    std::string problem;
  };

  void open(Output& output, Timestamp now);
  static void fail(Output& output, const Error& error);

  std::vector<Output> outputs_;
  LocalTouchFrame newest_;
  Timestamp came_{};
  bool silent_ = true;
};

}  // namespace telehug
