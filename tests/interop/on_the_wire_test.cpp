// SPDX-License-Identifier: Apache-2.0
//
// What somebody who listens on the network reads of two daemons: of a plain stream everything, by tshark's names too;
// of a pair's nothing but what docs/threat-model.md lists.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/erase.hpp>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include "integration/app/running_pair.hpp"
#include "interop/dissection.hpp"
#include "netlab/pcap_file.hpp"
#include "netlab/recorded_loopback.hpp"
#include "netlab/two_homes.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace {

using testing::Each;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::StartsWith;

const std::set<std::string> topics{
    "telehug/v1/active/touch", "telehug/v1/active/heartbeat",  "telehug/v1/active/status",  "telehug/v1/active/stop",
    "telehug/v1/passive/felt", "telehug/v1/passive/heartbeat", "telehug/v1/passive/status", "telehug/v1/passive/stop"};
const std::set<std::string> types{"telehug::v1::TouchEvent", "telehug::v1::Heartbeat", "telehug::v1::SideStatus",
                                  "telehug::v1::StopAll", "telehug::v1::Felt"};

// Long enough not to occur in a cipher by chance.
constexpr const char* parents_name = "Grandmother Rosalind";
constexpr const char* wearers_name = "Little Maximilian";

// Bytes to look for, each with what they are.
using Secrets = std::map<std::string, std::string>;

std::string raw(double value) {
  const auto bits = std::bit_cast<std::array<char, sizeof value>>(value);
  return {bits.begin(), bits.end()};
}

std::string raw(const SessionId& session) {
  std::string bytes;
  for (std::size_t i = 0; i < session.size(); i += 2)
    bytes += static_cast<char>(std::stoi(session.substr(i, 2), nullptr, 16));
  return bytes;
}

// A number that is not found by chance, as 0 or 0.5 would be.
bool is_telling(const std::string& bytes) {
  return std::ranges::count(bytes, '\0') <= 1;
}

// A datagram with its headers, put together if it came in pieces, or another frame; and what tshark says of it.
struct Seen {
  Bytes bytes;
  Dissection dissection;

  [[nodiscard]] bool holds(const std::string& what) const {
    const auto byte = [](char letter) { return static_cast<std::uint8_t>(letter); };
    return !std::ranges::search(bytes, what, {}, {}, byte).empty();
  }
};

// Two daemons with a finger on the picture for a while, and all that travelled between them from their start to their
// end.
struct Recording {
  std::vector<CapturedPacket> packets;
  std::vector<Seen> seen;
  Secrets payload;  // bytes that are known to have been sent
  std::string partition;

  [[nodiscard]] bool holds(const std::string& what) const {
    return std::ranges::any_of(seen, [&](const Seen& one) { return one.holds(what); });
  }
};

// Where a piece of an IPv4 datagram belongs in it, in bytes, and what is in it.
std::pair<std::size_t, Bytes> piece(const Bytes& frame) {
  constexpr std::size_t ip = 14;
  const std::size_t offset = std::size_t{8} * ((frame[ip + 6] & 0x1FU) << 8U | frame[ip + 7]);
  return {offset,
          Bytes(frame.begin() + static_cast<std::ptrdiff_t>(ip + std::size_t{4} * (frame[ip] & 0x0FU)), frame.end())};
}

void feel_touches(RunningPair& pair, const std::function<void()>& start_active, Recording& recording) {
  start_active();
  ASSERT_TRUE(eventually([&] { return pair.status(Side::active).is_object(); })) << pair.logs();
  ControlClient watch = std::get<ControlClient>(ControlClient::connect(pair.socket(Side::active)));
  ASSERT_TRUE(watch.ask({{"command", "watch"}}));
  ASSERT_TRUE(eventually([&] { return pair.felt() && pair.counter(Side::passive, "events_received") >= 60; }))
      << pair.logs();
  for (auto event = watch.next(100ms); event && *event; event = watch.next(0ms)) {
    if ((*event)->value("event", "") != "touch") continue;
    for (const char* number : {"x_mm", "y_mm", "x_fh", "y_fh", "speed_mm_s"}) {
      const std::string bytes = raw((*event)->at(number).get<double>());
      if (is_telling(bytes)) recording.payload[number] = bytes;
    }
  }
  for (const Side side : {Side::active, Side::passive})
    recording.payload[side_name(side) + " session"] = raw(pair.status(side).at("session").get<SessionId>());
  pair.active->end();
  pair.passive->end();
}

void look_into(const RunningPair& pair, Recording& recording) {
  ASSERT_LT(recording.packets.size(), 8000U) << "as many as can be kept; what came later is missing";
  const auto file = pair.folder / "packets.pcap";
  write_pcap(file, recording.packets);
  const std::vector<Dissection> frames = dissect(file);
  ASSERT_EQ(frames.size(), recording.packets.size());
  std::map<std::size_t, std::map<std::size_t, Bytes>> pieces;  // by the frame that completes them and their place
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (frames[i].whole_in != i) pieces[frames[i].whole_in].insert(piece(recording.packets[i].frame));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].whole_in != i) continue;
    Seen seen{recording.packets[i].frame, frames[i]};
    if (const auto of_it = pieces.find(i); of_it != pieces.end()) {
      of_it->second.insert(piece(recording.packets[i].frame));
      seen.bytes.clear();
      for (const auto& [offset, bytes] : of_it->second)
        seen.bytes.insert(seen.bytes.end(), bytes.begin(), bytes.end());
    }
    recording.seen.push_back(std::move(seen));
  }
}

class OnTheWire : public testing::Test {
 protected:
  // Records once for all tests of a suite.
  template <typename Record>
  static void record_once(std::optional<Recording>& recording, const Record& record) {
    if (recording) return;
    try {
      recording.emplace();
      record(*recording);
    } catch (const std::system_error& error) {
      recording.reset();
      GTEST_SKIP() << "network namespaces are not permitted here: " << error.what();
    }
  }
};

// Both daemons without a pair, on the loopback interface of a PC of their own.
class PlainStream : public OnTheWire {
 protected:
  void SetUp() override {
    record_once(recording, [](Recording& made) {
      const RecordedLoopback pc;
      RunningPair pair;
      made.partition = pair.partition();
      pair.start_jacket();
      pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
      const InsideNamespace inside(pc.network());
      pair.start_passive();
      ASSERT_NO_FATAL_FAILURE(feel_touches(
          pair, [&] { pair.start_active(); }, made));
      made.packets = pc.packets();
      look_into(pair, made);
    });
  }
  static void TearDownTestSuite() { recording.reset(); }
  static std::optional<Recording> recording;
};
std::optional<Recording> PlainStream::recording;

TEST_F(PlainStream, SubmessagesAreNamedByTshark) {
  std::set<std::string> names;
  for (const auto& [bytes, said] : recording->seen) {
    if (said.rtps) names.insert(said.submessages.begin(), said.submessages.end());
    EXPECT_EQ(said.info.find("Malformed"), std::string::npos) << said.info;
  }
  EXPECT_THAT(names, IsSupersetOf({"INFO_TS", "INFO_DST", "HEARTBEAT", "ACKNACK", "DATA(p)", "DATA(w)", "DATA(r)",
                                   "DATA -> telehug/v1/active/touch", "DATA -> telehug/v1/active/heartbeat",
                                   "DATA -> telehug/v1/passive/heartbeat", "DATA -> telehug/v1/passive/felt"}));
}

TEST_F(PlainStream, DiscoveryAnnouncesOurTopicsAndTypesInOurPartition) {
  std::map<std::string, std::set<std::string>> topics_by;  // by DATA(w) and DATA(r)
  std::set<std::string> announced_types;
  std::set<std::string> partitions;
  for (const auto& [bytes, said] : recording->seen) {
    announced_types.insert(said.types.begin(), said.types.end());
    partitions.insert(said.partitions.begin(), said.partitions.end());
    for (const char* kind : {"DATA(w)", "DATA(r)"})
      if (std::ranges::count(said.submessages, kind) > 0)
        topics_by[kind].insert(said.topics.begin(), said.topics.end());
  }
  for (const char* kind : {"DATA(w)", "DATA(r)"}) {
    EXPECT_THAT(topics_by[kind], IsSupersetOf(topics)) << kind;
    EXPECT_THAT(topics_by[kind], Each(StartsWith("telehug/v1/"))) << kind;
  }
  EXPECT_THAT(announced_types, IsSupersetOf(types));
  EXPECT_THAT(announced_types, Each(StartsWith("telehug::v1::")));
  EXPECT_EQ(partitions, std::set{recording->partition});
}

// What is looked for in a pair's stream is there to be found.
TEST_F(PlainStream, PayloadIsReadable) {
  EXPECT_GE(recording->payload.size(), 5U);
  for (const auto& [what, bytes] : recording->payload)
    EXPECT_TRUE(recording->holds(bytes)) << what;
}

// Both daemons as a pair in two homes.
class PairsStream : public OnTheWire {
 protected:
  void SetUp() override {
    record_once(recording, [](Recording& made) {
      TwoHomes homes(20261129);
      RunningPair pair;
      pair.loopback_only = false;
      PairStore parent = pair.pairs(Side::active);
      const auto granted =
          pair.pairs(Side::passive).grant(parent.request(parents_name).value(), wearers_name, wall_time()).value();
      made.partition = parent.accept(granted.grant, wall_time()).value().partition;
      id = granted.pair.id;
      phrase = granted.pair.phrase;
      homes.record(Home::parent);
      homes.record(Home::child);
      pair.start_jacket();
      pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
      {
        const InsideNamespace inside(homes.network(Home::child));
        pair.start_passive();
      }
      const auto start_active = [&] {
        const InsideNamespace inside(homes.network(Home::parent));
        pair.start_active();
      };
      ASSERT_NO_FATAL_FAILURE(feel_touches(pair, start_active, made));
      std::ranges::merge(homes.take_recording(Home::parent), homes.take_recording(Home::child),
                         std::back_inserter(made.packets), {}, &CapturedPacket::arrived, &CapturedPacket::arrived);
      look_into(pair, made);
    });
  }
  static void TearDownTestSuite() { recording.reset(); }

  static std::string kind(const Dissection& said) {
    if (!said.rtps) return "not RTPS";
    std::vector<std::string> parts = said.submessages;
    // Fast DDS adds one of its own to every message: the time, a count of messages and of bytes.
    std::erase(parts, "Unknown[80]");
    const std::set<std::string> names(parts.begin(), parts.end());
    const auto all_by = [&](const char* writer) {
      return std::ranges::all_of(said.writers, [=](const std::string& id) { return id == writer; });
    };
    if ((names == std::set<std::string>{"INFO_TS", "DATA(p)"} ||
         names == std::set<std::string>{"INFO_TS", "DATA(p[UD])"}) &&
        all_by("0x000100c2"))
      return "announcement";
    if (names == std::set<std::string>{"INFO_DST", "INFO_TS", "DATA(s)"} && all_by("0x000201c3")) return "handshake";
    if (names == std::set<std::string>{"INFO_DST", "SEC_PREFIX", "SEC_BODY", "SEC_POSTFIX"} && said.writers.empty())
      return "keys";
    if (parts == std::vector<std::string>{"SRTPS_PREFIX", "SEC_BODY", "SRTPS_POSTFIX"}) return "encrypted";
    return "unprotected";
  }
  // Kinds of message that hold this in clear.
  static std::set<std::string> readable_in(const std::string& bytes) {
    std::set<std::string> kinds;
    for (const Seen& seen : recording->seen)
      if (seen.holds(bytes)) kinds.insert(kind(seen.dissection));
    return kinds;
  }

  static std::optional<Recording> recording;
  static std::string id;
  static std::string phrase;
};
std::optional<Recording> PairsStream::recording;
std::string PairsStream::id;
std::string PairsStream::phrase;

TEST_F(PairsStream, EverythingIsEncryptedButAnnouncementsAndTheHandshake) {
  std::map<std::string, int> counts;
  std::map<std::string, int> encrypted_by;
  for (const auto& [bytes, said] : recording->seen) {
    ++counts[kind(said)];
    EXPECT_NE(kind(said), "unprotected") << said.info;
    if (kind(said) == "encrypted") ++encrypted_by[said.source];
  }
  for (const auto& [name, count] : counts)
    fmt::print("{} x {}\n", count, name);
  EXPECT_GE(counts["handshake"], 3);
  // Of the 60 events and more that were received none came otherwise.
  EXPECT_GE(encrypted_by[TwoHomes::address(Home::parent)], 60);
  EXPECT_GE(encrypted_by[TwoHomes::address(Home::child)], 10);
}

TEST_F(PairsStream, HidesTouchesAndPeople) {
  Secrets secrets = recording->payload;
  EXPECT_GE(secrets.size(), 5U);
  for (const std::string& text : {std::string(parents_name), std::string(wearers_name), phrase,
                                  std::string("TouchEvent"), std::string("telehug::")})
    secrets[text] = text;
  for (const auto& [what, bytes] : secrets)
    EXPECT_THAT(readable_in(bytes), IsEmpty()) << what;
}

// The handshake of DDS Security shows each side's permissions in clear.
TEST_F(PairsStream, TopicsAndPartitionAreReadableInTheHandshakeAlone) {
  for (const std::string& topic : topics)
    EXPECT_EQ(readable_in(topic), std::set<std::string>{"handshake"}) << topic;
  EXPECT_EQ(readable_in(recording->partition), std::set<std::string>{"handshake"});
}

TEST_F(PairsStream, AnnouncementsTellTheNamesInTheCertificatesAndNothingElseOfUs) {
  std::vector<std::string> subjects;
  for (const std::string& name : {"parent-" + id, "wearer-" + id, id + " identities", id + " permissions"}) {
    subjects.push_back("/O=telehug/CN=" + name);
    EXPECT_EQ(readable_in(subjects.back()), (std::set<std::string>{"announcement", "handshake"})) << name;
  }
  for (const auto& [bytes, said] : recording->seen) {
    if (kind(said) == "handshake") continue;
    std::string text(bytes.begin(), bytes.end());
    for (const std::string& subject : subjects)
      boost::algorithm::erase_all(text, subject);
    boost::algorithm::to_lower(text);
    for (const std::string& word : {std::string("telehug"), id, std::string("physical_data")})
      EXPECT_EQ(text.find(word), std::string::npos) << word << " in " << said.info;
  }
}

}  // namespace
}  // namespace telehug
