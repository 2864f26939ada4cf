// SPDX-License-Identifier: Apache-2.0
//
// A sender of touches that is no telehug-active: it checks neither its pair nor what it sends. One finger rests on a
// box of the trunk for ever. It says on stdout, a line each, "heard" when the wearer's side is, "felt" when a touch
// was.
#include <fastcdr/Cdr.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "dds/participant_impl.hpp"
#include "dds/qos.hpp"
#include "dds/reader.hpp"
#include "dds/wire.hpp"
#include "dds/writer.hpp"
#include "pairing/pair_files.hpp"
#include "peer/heartbeat_exchange.hpp"
#include "peer/session_id.hpp"

// In place of Fast DDS' own, which would not let a side write what it is not permitted: whether the other side lets it
// is what a test wants to know.
namespace eprosima::fastrtps::rtps::security {

class Handle;
class SecurityException;
class Permissions {
 public:
  bool check_create_datawriter(const Handle& own, std::uint32_t domain, const std::string& topic,
                               const std::vector<std::string>& partitions, SecurityException& problem);
};

bool Permissions::check_create_datawriter(const Handle& /*own*/, std::uint32_t /*domain*/, const std::string& /*topic*/,
                                          const std::vector<std::string>& /*partitions*/,
                                          SecurityException& /*problem*/) {
  return true;
}

}  // namespace eprosima::fastrtps::rtps::security

namespace telehug {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

// The wire type, without the bounds that the generated code would refuse to send.
class UncheckedType : public Topic<TouchEvent>::WireSupport {
 public:
  UncheckedType() { m_typeSize = 8192; }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    using eprosima::fastcdr::Cdr;
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    payload->encapsulation = CDR_LE;
    cdr.serialize_encapsulation();
    static_cast<v1::TouchEvent*>(data)->serialize(cdr);
    payload->length = static_cast<std::uint32_t>(cdr.getSerializedDataLength());
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* /*data*/) override {
    return [size = m_typeSize] { return size; };
  }
};

class UncheckedWriter {
 public:
  explicit UncheckedWriter(DdsParticipant& participant) : inside_(*participant.impl()) {
    dds::TypeSupport type(new UncheckedType());
    type.register_type(inside_.participant);
    dds::Topic* topic = inside_.participant->create_topic(topic_name<TouchEvent>(Side::active), type.get_type_name(),
                                                          dds::TOPIC_QOS_DEFAULT);
    if (topic != nullptr) writer_ = inside_.publisher->create_datawriter(topic, writer_qos<TouchEvent>());
    if (writer_ == nullptr) throw DdsError("DDS refused a writer of touches");
  }
  void write(v1::TouchEvent& event) { writer_->write(&event); }

 private:
  DdsParticipant::Impl& inside_;
  dds::DataWriter* writer_ = nullptr;
};

void say(const std::string& line) {
  (void)std::printf("%s\n", line.c_str());
  (void)std::fflush(stdout);
}

struct Options {
  std::uint32_t domain = 0;
  std::filesystem::path store;
  std::string id;
  bool plain = false;
  std::uint64_t bad = 0;  // how many bad events it sends among the good ones
};

TouchEvent resting_finger(const SessionId& session) {
  TouchEvent event;
  event.session = session;
  event.body_map_version = 1;
  event.contacts.push_back({.id = 1,
                            .phase = Phase::move,
                            .box = 7,
                            .grid = {.columns = 5, .rows = 4},
                            .body = {.x_fh = -0.5, .y_fh = 1},
                            .screen = {.x_mm = 200, .y_mm = 150},
                            .strength = 1,
                            .gesture = Gesture::hold});
  return event;
}

// An over-long sequence, values that no enumeration has, and numbers that are none, in turn.
void spoil(v1::TouchEvent& event, std::uint64_t which) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  v1::Contact& contact = event.contacts().at(0);
  switch (which % 6) {
    case 0:
      event.contacts().resize(max_contacts + 1, contact);
      break;
    case 1:
      event.transitions().resize(max_transitions + 1);
      break;
    case 2:
      contact.phase(static_cast<v1::Phase>(99));
      break;
    case 3:
      contact.gesture(static_cast<v1::Gesture>(99));
      break;
    case 4:
      contact.strength(nan);
      break;
    default:
      contact.body_x_fh(nan);
      break;
  }
}

int run(const Options& options) {
  DdsSettings settings{
      .side = Side::active, .domain_id = options.domain, .partition = partition_of(options.id), .loopback_only = false};
  if (!options.plain) settings.security = files_in(options.store / options.id);
  DdsParticipant participant(settings);
  const SessionId session = new_session_id();
  const SteadyClock clock;
  std::atomic<std::uint64_t> heard = 0;
  std::atomic<std::uint64_t> felt = 0;
  Writer<Heartbeat> heartbeats(participant);
  const Reader<Heartbeat> peer(participant, [&](const Heartbeat&) {
    if (heard++ == 0) say("heard");
  });
  const Reader<Felt> answers(participant, [&](const Felt& answer) {
    if (answer.outcome == FeltOutcome::driven && felt++ == 0) say("felt");
  });
  UncheckedWriter touches(participant);

  HeartbeatExchange exchange(session, Side::active);
  TouchEvent event = resting_finger(session);
  v1::TouchEvent wire;
  std::uint64_t bad_sent = 0;
  while (true) {
    const Timestamp now = clock.now();
    if (now >= exchange.next_due()) heartbeats.write(exchange.beat(now));
    ++event.sequence;
    event.frame_time_ns = event.sent_time_ns = to_ns(now);
    to_wire(event, wire);
    touches.write(wire);
    if (felt > 0 && bad_sent < options.bad) {
      spoil(wire, bad_sent);
      touches.write(wire);
      if (++bad_sent == options.bad) say("bad sent");
    }
    std::this_thread::sleep_until(now + 16ms);
  }
}

}  // namespace
}  // namespace telehug

int main(int argc, char** argv) {
  CLI::App app("Sends touches of a finger that rests", "purpose-made-sender");
  telehug::Options options;
  app.add_option("--domain", options.domain)->required();
  app.add_option("--store", options.store)->required();
  app.add_option("--id", options.id)->required();
  app.add_flag("--plain", options.plain, "Without DDS Security");
  app.add_option("--bad", options.bad, "So many bad events among the good ones, from when the finger is felt");
  CLI11_PARSE(app, argc, argv);
  try {
    return telehug::run(options);
  } catch (const std::exception& problem) {
    telehug::say(problem.what());
    return 1;
  }
}
