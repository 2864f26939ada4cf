// SPDX-License-Identifier: Apache-2.0
//
// MQTT with QoS 0 over TLS, as fast as libmosquitto can be made: without its own thread, which would be woken for every
// message, and without Nagle's algorithm.
#include <mosquitto.h>

#include <stdexcept>
#include <string>
#include <thread>

#include "bench/homes/event_codec.hpp"
#include "bench/homes/touch_ways.hpp"
#include "common/clock.hpp"

namespace telehug {
namespace {

constexpr const char* topic = "telehug/touch";
constexpr int keepalive_s = 60;
constexpr int qos = 0;

void require(int code, const char* what) {
  if (code == MOSQ_ERR_SUCCESS) return;
  throw std::runtime_error(std::string(what) + ": " + mosquitto_strerror(code));
}

// A connection to the broker, which may still have to come up.
class MqttClient {
 public:
  explicit MqttClient(const Meeting& meeting) {
    mosquitto_lib_init();
    client_ = mosquitto_new(nullptr, true, this);
    if (client_ == nullptr) throw std::runtime_error("no MQTT client can be made");
    const std::string certificate = meeting.folder / broker_certificate;
    require(mosquitto_tls_set(client_, certificate.c_str(), nullptr, nullptr, nullptr, nullptr), "TLS");
    require(mosquitto_int_option(client_, MOSQ_OPT_TCP_NODELAY, 1), "TCP_NODELAY");
    mosquitto_connect_callback_set(client_, [](mosquitto*, void* self, int) {
      auto& own = *static_cast<MqttClient*>(self);
      if (own.receive_) (void)mosquitto_subscribe(own.client_, nullptr, topic, qos);
    });
    mosquitto_message_callback_set(client_, [](mosquitto*, void* self, const mosquitto_message* message) {
      auto& own = *static_cast<MqttClient*>(self);
      const auto* bytes = static_cast<const std::uint8_t*>(message->payload);
      const TouchEvent* event = own.codec_.decode({bytes, static_cast<std::size_t>(message->payloadlen)});
      if (event != nullptr) own.receive_(*event);
    });
    while (mosquitto_connect(client_, meeting.address.c_str(), broker_port, keepalive_s) != MOSQ_ERR_SUCCESS)
      std::this_thread::sleep_for(50ms);
  }
  ~MqttClient() { mosquitto_destroy(client_); }
  MqttClient(const MqttClient&) = delete;
  MqttClient& operator=(const MqttClient&) = delete;

  void receive_with(const Receive& receive) { receive_ = receive; }
  void publish(const TouchEvent& event) {
    const auto bytes = codec_.encode(event);
    (void)mosquitto_publish(client_, nullptr, topic, static_cast<int>(bytes.size()), bytes.data(), qos, false);
  }
  // What waits to be read or written, and whatever else the protocol asks for.
  void serve(std::chrono::milliseconds longest) {
    constexpr int packets = 1;
    if (mosquitto_loop(client_, static_cast<int>(longest.count()), packets) != MOSQ_ERR_SUCCESS) {
      (void)mosquitto_reconnect(client_);
    }
  }

 private:
  mosquitto* client_ = nullptr;
  EventCodec codec_;
  Receive receive_;
};

class MqttSender final : public TouchSender {
 public:
  explicit MqttSender(const Meeting& meeting) : client_(meeting) {}
  void send(const TouchEvent& event) override {
    client_.publish(event);
    client_.serve(0ms);
  }

 private:
  MqttClient client_;
};

}  // namespace

std::unique_ptr<TouchSender> mqtt_sender(const Meeting& meeting) {
  return std::make_unique<MqttSender>(meeting);
}

void receive_mqtt(const Meeting& meeting, const Receive& receive) {
  MqttClient client(meeting);
  client.receive_with(receive);
  for (;;)
    client.serve(1s);
}

}  // namespace telehug
