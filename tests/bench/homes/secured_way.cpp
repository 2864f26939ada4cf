// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <stdexcept>
#include <thread>

#include "bench/homes/touch_ways.hpp"
#include "common/clock.hpp"
#include "dds/participant.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"
#include "pairing/pairing.hpp"

namespace telehug {
namespace {

DdsSettings settings(const Meeting& meeting, Side side) {
  const char* folder = side == Side::active ? parents_pairs : wearers_pairs;
  const auto pairs = PairStore(meeting.folder / folder, side).list();
  if (pairs.size() != 1) throw std::runtime_error("the benchmark's pair is missing");
  return {.side = side,
          .domain_id = 1,
          .partition = pairs[0].partition,
          .loopback_only = meeting.loopback,
          .security = pairs[0].files};
}

class SecuredSender final : public TouchSender {
 public:
  explicit SecuredSender(const Meeting& meeting) : participant_(settings(meeting, Side::active)) {
    while (writer_.matched() == 0)
      std::this_thread::sleep_for(5ms);
  }
  void send(const TouchEvent& event) override { (void)writer_.write(event); }

 private:
  DdsParticipant participant_;
  Writer<TouchEvent> writer_{participant_};
};

}  // namespace

std::unique_ptr<TouchSender> secured_sender(const Meeting& meeting) {
  return std::make_unique<SecuredSender>(meeting);
}

void receive_secured(const Meeting& meeting, const Receive& receive) {
  DdsParticipant participant(settings(meeting, Side::passive));
  const Reader<TouchEvent> reader(participant, receive);
  for (;;)
    pause();
}

}  // namespace telehug
