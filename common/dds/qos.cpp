// SPDX-License-Identifier: Apache-2.0
#include "dds/qos.hpp"

#include <arpa/inet.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "dds/filtering_transport.hpp"
#include "dds/participant_number.hpp"

namespace telehug {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastrtps::Duration_t;

namespace {

constexpr const char* loopback_address = "127.0.0.1";
constexpr int felt_history = 64;
// A restarted sender leaves its session behind as an instance until the lease ends; the default of 10 would refuse the
// eleventh restart. So many that a peer can't shut others out by inventing a few thousand sessions.
constexpr int max_sessions = 100'000;

// port 0: those that the domain id gives.
rtps::Locator_t udp_locator(const std::string& address, std::uint32_t port = 0) {
  in_addr parsed{};
  if (inet_pton(AF_INET, address.c_str(), &parsed) != 1 || port > 65'535) {
    throw std::invalid_argument(fmt::format("\"{}\" is not an IPv4 address such as 192.0.2.7", address));
  }
  rtps::Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  locator.port = port;
  rtps::IPLocator::setIPv4(locator, address);
  return locator;
}

// "192.0.2.7" or "192.0.2.7:7600"
rtps::Locator_t peer_locator(const std::string& peer) {
  const std::size_t colon = std::min(peer.find(':'), peer.size());
  std::uint32_t port = 0;
  if (colon < peer.size()) {
    const char* const end = peer.data() + peer.size();
    const auto [next, error] = std::from_chars(peer.data() + colon + 1, end, port);
    if (error != std::errc() || next != end || port == 0) {
      throw std::invalid_argument(fmt::format("the peer \"{}\" has no port behind its colon", peer));
    }
  }
  return udp_locator(peer.substr(0, colon), port);
}

// A router translates the addresses of packets, not those that DDS tells within them. So that the other side learns
// one that leads here, ports are fixed, and the router's address is told beside this PC's own.
void announce(dds::DomainParticipantQos& qos, const PublicAddress& known_as, std::uint32_t domain_id) {
  auto& wire = qos.wire_protocol();
  const auto at_router = [&](std::uint32_t port) {
    eprosima::fastdds::rtps::LocatorWithMask locator;
    static_cast<rtps::Locator_t&>(locator) = udp_locator(known_as.address, port);
    return locator;
  };
  const std::uint32_t discovery = known_as.port;
  const std::uint32_t data = discovery + 1;
  const std::string every_interface = "0.0.0.0";
  wire.builtin.metatrafficUnicastLocatorList.push_back(udp_locator(every_interface, discovery));
  wire.default_unicast_locator_list.push_back(udp_locator(every_interface, data));
  wire.builtin.metatraffic_external_unicast_locators[1][0].push_back(at_router(discovery));
  wire.default_external_unicast_locators[1][0].push_back(at_router(data));
  // Said here since the library leaves it out once unicast is said; the own network is still to be heard.
  wire.builtin.metatrafficMulticastLocatorList.push_back(udp_locator("239.255.0.1", 7400 + 250 * domain_id));
}

// DDS Security 1.1, 9.3 to 9.5: who is who by certificates, who may what by signed permissions, AES-GCM.
void secure(dds::DomainParticipantQos& qos, const DdsSecurityFiles& files) {
  auto& properties = qos.properties().properties();
  const auto set = [&](const char* name, const std::string& value) { properties.emplace_back(name, value); };
  const auto file = [&](const char* name, const std::filesystem::path& path) {
    set(name, "file://" + std::filesystem::absolute(path).string());
  };
  set("dds.sec.auth.plugin", "builtin.PKI-DH");
  file("dds.sec.auth.builtin.PKI-DH.identity_ca", files.identity_ca);
  file("dds.sec.auth.builtin.PKI-DH.identity_certificate", files.certificate);
  file("dds.sec.auth.builtin.PKI-DH.private_key", files.private_key);
  set("dds.sec.access.plugin", "builtin.Access-Permissions");
  file("dds.sec.access.builtin.Access-Permissions.permissions_ca", files.permissions_ca);
  file("dds.sec.access.builtin.Access-Permissions.governance", files.governance);
  file("dds.sec.access.builtin.Access-Permissions.permissions", files.permissions);
  set("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
}

// Newest wins and nothing waits: a lost sample is made good by the next one.
template <typename Qos>
void best_effort_newest(Qos& qos) {
  qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 1;
}

template <typename Qos>
void reliable(Qos& qos, int depth) {
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = depth;
}

// A side that joins late learns the present state.
template <typename Qos>
void reliable_state(Qos& qos) {
  reliable(qos, 1);
  qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
}

// Large and rare: the default sets aside room for a hundred of them.
template <typename Qos>
void one_at_a_time(Qos& qos) {
  qos.resource_limits().allocated_samples = 1;
}

// For a reader of a type whose key is the session: one sample of each.
void one_of_each_session(dds::DataReaderQos& qos) {
  qos.resource_limits().max_instances = max_sessions;
  qos.resource_limits().max_samples_per_instance = 1;
  qos.resource_limits().max_samples = max_sessions;
}

template <typename T, typename Qos>
void choose_delivery(Qos& qos);
template <>
void choose_delivery<TouchEvent>(dds::DataWriterQos& qos) {
  best_effort_newest(qos);
}
template <>
void choose_delivery<TouchEvent>(dds::DataReaderQos& qos) {
  best_effort_newest(qos);
  one_of_each_session(qos);
}
template <>
void choose_delivery<Heartbeat>(dds::DataWriterQos& qos) {
  best_effort_newest(qos);
}
template <>
void choose_delivery<Heartbeat>(dds::DataReaderQos& qos) {
  best_effort_newest(qos);
  one_of_each_session(qos);
}
template <>
void choose_delivery<Felt>(dds::DataWriterQos& qos) {
  reliable(qos, felt_history);
}
template <>
void choose_delivery<Felt>(dds::DataReaderQos& qos) {
  reliable(qos, felt_history);
}
template <>
void choose_delivery<SideStatus>(dds::DataWriterQos& qos) {
  reliable_state(qos);
}
template <>
void choose_delivery<SideStatus>(dds::DataReaderQos& qos) {
  reliable_state(qos);
  one_of_each_session(qos);
}
template <>
void choose_delivery<StopAll>(dds::DataWriterQos& qos) {
  reliable_state(qos);
}
template <>
void choose_delivery<StopAll>(dds::DataReaderQos& qos) {
  reliable_state(qos);
  one_of_each_session(qos);
}
template <>
void choose_delivery<PairRenewal>(dds::DataWriterQos& qos) {
  reliable_state(qos);
  one_at_a_time(qos);
}
template <>
void choose_delivery<PairRenewal>(dds::DataReaderQos& qos) {
  reliable_state(qos);
  one_of_each_session(qos);
  one_at_a_time(qos);
}
// Not kept for whoever joins late: a hug is for the moment.
template <>
void choose_delivery<Hug>(dds::DataWriterQos& qos) {
  reliable(qos, 1);
}
template <>
void choose_delivery<Hug>(dds::DataReaderQos& qos) {
  reliable(qos, 1);
  one_of_each_session(qos);
}

}  // namespace

dds::DomainParticipantQos participant_qos(const DdsSettings& settings) {
  if (settings.loopback_only && !settings.peers.empty()) {
    throw std::invalid_argument("peers are listed, but only loopback is allowed: remove one of the two settings");
  }
  if (settings.loopback_only && settings.public_address) {
    throw std::invalid_argument("a public address is given, but only loopback is allowed: remove one of the two");
  }
  dds::DomainParticipantQos qos;
  // Announcements are readable on the network even with DDS Security, each second. Fast DDS would put the names of this
  // PC and its user there.
  qos.properties().properties().clear();
  const char* side = settings.side == Side::active ? "telehug-active" : "telehug-passive";
  qos.name(settings.security ? "" : side);

  // UDPv4 only. Shared memory would leave world-readable files behind after a crash.
  qos.transport().use_builtin_transports = false;
  const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  auto& builtin = qos.wire_protocol().builtin;
  if (settings.loopback_only) {
    udp->interfaceWhiteList.emplace_back(loopback_address);
    udp->maxInitialPeersRange = max_loopback_participants;
    builtin.initialPeersList.push_back(udp_locator(loopback_address));
  }
  for (const std::string& peer : settings.peers)
    builtin.initialPeersList.push_back(peer_locator(peer));
  if (settings.public_address) announce(qos, *settings.public_address, settings.domain_id);
  if (settings.security) {
    qos.transport().user_transports.push_back(filtering(udp));
  } else {
    qos.transport().user_transports.push_back(udp);
  }

  // A long lease: a side that drops the other after a short one-way loss may never find it again once DDS security is
  // on. Who lives is for the heartbeats to say. Announcing each second lets a late joiner match within that time.
  builtin.discovery_config.leaseDuration = Duration_t(600, 0);
  builtin.discovery_config.leaseDuration_announcementperiod = Duration_t(1, 0);
  if (settings.security) secure(qos, *settings.security);
  return qos;
}

template <typename T>
dds::DataWriterQos writer_qos() {
  dds::DataWriterQos qos;
  choose_delivery<T>(qos);
  qos.publish_mode().kind =
      dds::SYNCHRONOUS_PUBLISH_MODE;  // sent by the caller's thread; the other mode costs 7 ms p99
  qos.data_sharing().off();
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  // How soon a reliable sample that was lost is sent again: the default of 3 s leaves gaps of seconds.
  qos.reliable_writer_qos().times.heartbeatPeriod = Duration_t(0, 100'000'000);
  qos.reliable_writer_qos().times.nackResponseDelay = Duration_t(0, 0);
  return qos;
}

template <typename T>
dds::DataReaderQos reader_qos() {
  dds::DataReaderQos qos;
  choose_delivery<T>(qos);
  qos.data_sharing().off();
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.reliable_reader_qos().times.heartbeatResponseDelay = Duration_t(0, 0);
  return qos;
}

template dds::DataWriterQos writer_qos<TouchEvent>();
template dds::DataWriterQos writer_qos<Felt>();
template dds::DataWriterQos writer_qos<Heartbeat>();
template dds::DataWriterQos writer_qos<SideStatus>();
template dds::DataWriterQos writer_qos<StopAll>();
template dds::DataWriterQos writer_qos<PairRenewal>();
template dds::DataWriterQos writer_qos<Hug>();
template dds::DataReaderQos reader_qos<TouchEvent>();
template dds::DataReaderQos reader_qos<Felt>();
template dds::DataReaderQos reader_qos<Heartbeat>();
template dds::DataReaderQos reader_qos<SideStatus>();
template dds::DataReaderQos reader_qos<StopAll>();
template dds::DataReaderQos reader_qos<PairRenewal>();
template dds::DataReaderQos reader_qos<Hug>();

}  // namespace telehug
