// SPDX-License-Identifier: Apache-2.0
//
// The active side of a benchmark: sends what it is told to, and keeps what the wearer's side answers.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "dds/participant.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"

namespace telehug {

class TouchingPeer {
 public:
  explicit TouchingPeer(const DdsSettings& settings);
  ~TouchingPeer();
  TouchingPeer(const TouchingPeer&) = delete;
  TouchingPeer& operator=(const TouchingPeer&) = delete;

  [[nodiscard]] bool heard() const noexcept { return heard_; }

  // Sends an event with these contacts, and the downs and ups among them as transitions.
  void send(const std::vector<Contact>& contacts);
  // Answers since the last call.
  [[nodiscard]] std::vector<Felt> take_answers();

 private:
  void beat();

  const SteadyClock clock_;
  const SessionId session_;
  DdsParticipant participant_;
  std::atomic<bool> heard_ = false;
  std::mutex mutex_;
  std::vector<Felt> answers_;  // guarded by mutex_
  Writer<Heartbeat> heartbeats_;
  Writer<TouchEvent> events_;
  Reader<Heartbeat> peer_;
  Reader<Felt> felt_;
  TouchEvent event_;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace telehug
