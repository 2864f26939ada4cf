// SPDX-License-Identifier: Apache-2.0
#include "local_touch/local_touch_outputs.hpp"

namespace telehug {
namespace {

bool same_size(const ScreenSize& a, const ScreenSize& b) {
  return a.width_mm == b.width_mm && a.height_mm == b.height_mm;
}

}  // namespace

LocalTouchOutputs::LocalTouchOutputs(std::vector<std::unique_ptr<LocalTouchOutput>> outputs) {
  for (auto& output : outputs)
    outputs_.push_back({std::move(output), false, std::nullopt, ""});
}

void LocalTouchOutputs::serve(const LocalTouchFrame* frame, Timestamp now) {
  if (frame != nullptr) {
    if (!same_size(frame->screen, newest_.screen)) close();
    newest_ = *frame;
    came_ = now;
    silent_ = false;
  } else if (!silent_ && now - came_ >= silence) {
    newest_.contacts.clear();
    newest_.time = now;
    silent_ = true;
    frame = &newest_;
  }
  if (!(newest_.screen.width_mm > 0) || !(newest_.screen.height_mm > 0)) return;
  for (Output& output : outputs_) {
    if (!output.open) open(output, now);
    if (!output.open || frame == nullptr) continue;
    if (const Status sent = output.output->send(newest_.contacts, newest_.time); !sent) fail(output, sent.error());
  }
}

void LocalTouchOutputs::open(Output& output, Timestamp now) {
  if (output.tried && now - *output.tried < retry_interval) return;
  output.tried = now;
  if (const Status opened = output.output->open(newest_.screen); !opened) {
    fail(output, opened.error());
    return;
  }
  output.open = true;
  output.problem.clear();
}

void LocalTouchOutputs::fail(Output& output, const Error& error) {
  output.output->close();
  output.open = false;
  output.problem = error.message;
}

void LocalTouchOutputs::close() {
  for (Output& output : outputs_) {
    output.output->close();
    output.open = false;
    output.tried.reset();
  }
}

std::vector<LocalTouchState> LocalTouchOutputs::states() const {
  std::vector<LocalTouchState> states;
  states.reserve(outputs_.size());
  for (const Output& output : outputs_)
    states.push_back({output.output->name(), output.open, output.problem});
  return states;
}

}  // namespace telehug
