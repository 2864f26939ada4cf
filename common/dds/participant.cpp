// SPDX-License-Identifier: Apache-2.0
#include "dds/participant.hpp"

#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "dds/participant_impl.hpp"
#include "dds/qos.hpp"

namespace telehug {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

// A writer must never run a reader's callback, not even in one process: every message goes through the transport.
void deliver_through_the_transport_only() {
  eprosima::fastrtps::LibrarySettingsAttributes library;
  library.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(library);
}

// Fast DDS would silently take another port, to which no router forwards anything.
void require_free(std::uint16_t port) {
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in any{};
  any.sin_family = AF_INET;
  any.sin_port = htons(port);
  const bool free = probe >= 0 && bind(probe, reinterpret_cast<const sockaddr*>(&any), sizeof any) == 0;
  const int problem = errno;
  if (probe >= 0) close(probe);
  if (free) return;
  throw DdsError(fmt::format("UDP port {}, which the router forwards (peer.public_port), can't be used: {}", port,
                             std::generic_category().message(problem)));
}

template <typename Qos>
Qos in_partition(Qos qos, const std::string& partition) {
  qos.partition().push_back(partition.c_str());
  return qos;
}

Strangers::Id id_of(const rtps::GUID_t& guid) {
  Strangers::Id id{};
  std::copy_n(guid.guidPrefix.value, id.size(), id.begin());
  return id;
}

std::string address_of(const rtps::ParticipantProxyData& participant) {
  const auto& locators = participant.metatraffic_locators.unicast;
  return locators.empty() ? "an unknown address" : rtps::IPLocator::ip_to_string(*locators.begin());
}

}  // namespace

void SignsOfPeers::on_participant_discovery(dds::DomainParticipant* /*own*/, Discovery&& info) {
  switch (info.status) {
    case Discovery::DISCOVERED_PARTICIPANT:
      strangers.discovered(id_of(info.info.m_guid), address_of(info.info), SteadyClock{}.now());
      ++count;
      break;
    case Discovery::REMOVED_PARTICIPANT:
    case Discovery::DROPPED_PARTICIPANT:
      strangers.gone(id_of(info.info.m_guid));
      break;
    default:
      break;
  }
}

#if HAVE_SECURITY
void SignsOfPeers::onParticipantAuthentication(dds::DomainParticipant* /*own*/, Authentication&& info) {
  if (info.status == Authentication::AUTHORIZED_PARTICIPANT) {
    strangers.proved(id_of(info.guid));
    ++count;
  } else {
    strangers.refused(id_of(info.guid));
  }
}
#endif

DdsParticipant::Impl::Impl(const DdsSettings& settings) : side(settings.side), secured(settings.security.has_value()) {
  if (settings.domain_id > max_domain_id) {
    throw std::invalid_argument(
        fmt::format("DDS domain {} is out of range: choose 0 to {}", settings.domain_id, max_domain_id));
  }
  if (settings.partition.empty() || settings.partition.find_first_of("*?[]") != std::string::npos) {
    throw std::invalid_argument(
        fmt::format("the DDS partition \"{}\" is empty or holds a wildcard: choose a plain name", settings.partition));
  }
  dds::DomainParticipantQos qos = participant_qos(settings);
  qos.wire_protocol().participant_id = number.value();
  if (settings.public_address) {
    require_free(settings.public_address->port);
    require_free(static_cast<std::uint16_t>(settings.public_address->port + 1));
  }
  deliver_through_the_transport_only();
  participant = dds::DomainParticipantFactory::get_instance()->create_participant(settings.domain_id, qos, &signs,
                                                                                  dds::StatusMask::none());
  if (participant == nullptr) {
    number.use_up();
    throw DdsError(fmt::format("DDS could not join domain {}: are its UDP ports (from {}) free and the network up{}?",
                               settings.domain_id, 7400 + 250 * settings.domain_id,
                               settings.security ? ", and the pair's files valid" : ""));
  }
  publisher = participant->create_publisher(in_partition(dds::PUBLISHER_QOS_DEFAULT, settings.partition));
  subscriber = participant->create_subscriber(in_partition(dds::SUBSCRIBER_QOS_DEFAULT, settings.partition));
  if (publisher == nullptr || subscriber == nullptr) {
    participant->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
    throw DdsError("DDS could not make a publisher and a subscriber in its own participant");
  }
}

DdsParticipant::Impl::~Impl() {
  participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
}

dds::Topic* DdsParticipant::Impl::find_or_create(const std::string& name, const dds::TypeSupport& type) {
  if (auto* known = dynamic_cast<dds::Topic*>(participant->lookup_topicdescription(name))) return known;
  const std::string& type_name = type.get_type_name();
  if (participant->find_type(type_name).empty()) type.register_type(participant);
  dds::Topic* created = participant->create_topic(name, type_name, dds::TOPIC_QOS_DEFAULT);
  if (created == nullptr) throw DdsError(fmt::format("DDS refused the topic {}", name));
  return created;
}

DdsParticipant::DdsParticipant(const DdsSettings& settings) : impl_(std::make_shared<Impl>(settings)) {}
DdsParticipant::~DdsParticipant() = default;

std::uint64_t DdsParticipant::signs_of_peers() const noexcept {
  return impl_->signs.count;
}

std::optional<Stranger> DdsParticipant::stranger() const {
  return impl_->secured ? impl_->signs.strangers.longest_here(SteadyClock{}.now()) : std::nullopt;
}

std::uint64_t DdsParticipant::refusals() const {
  return impl_->signs.strangers.refusals();
}

}  // namespace telehug

// GCC defines a macro, clang has a feature.
#if defined(__SANITIZE_ADDRESS__)
#define TELEHUG_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TELEHUG_ADDRESS_SANITIZER 1
#endif
#endif

#ifdef TELEHUG_ADDRESS_SANITIZER
// Debian's libfastrtps 2.9.1 deletes what RTPSWriter allocated with another size than it was made with (seen in
// ~RTPSWriter). The address sanitizer checks nothing else about sizes of deletes, so only this check is off, for every
// program that links Fast DDS.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier): the sanitizer's name
  return "new_delete_type_mismatch=0";
}
#endif
