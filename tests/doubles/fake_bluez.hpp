// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sdbus-c++/sdbus-c++.h>

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "doubles/socket_pair.hpp"

namespace telehug {

// BlueZ with one device, 00:1A:7D:DA:71:13, as BlueZ's documents (doc/device-api.txt, profile-api.txt) describe it. Its
// connections are pairs of sockets.
class FakeBluez {
 public:
  struct Script {
    bool has_adapter = true;
    bool powered = true;
    bool knows_device = true;
    bool paired = true;
    bool connected = false;
    std::vector<std::string> uuids = {"0000110a-0000-1000-8000-00805f9b34fb", "00001101-0000-1000-8000-00805f9b34fb"};
    std::string registering_fails{};  // name of an error; empty: it does not fail
    std::string connecting_fails{};   // "name: message"
    bool answers = true;              // ConnectProfile
    bool hands_over = true;           // the connection
    std::string wrong_device{};       // the path it says the connection is of
  };

  FakeBluez(const std::string& bus_address, Script script);
  ~FakeBluez();
  FakeBluez(const FakeBluez&) = delete;
  FakeBluez& operator=(const FakeBluez&) = delete;

  void rewrite(const std::function<void(Script&)>& change);

  // Waits until so many connections were asked for.
  [[nodiscard]] bool was_asked(std::size_t times) const;
  // The far end of the newest connection.
  [[nodiscard]] std::shared_ptr<SocketPair> connection() const;
  [[nodiscard]] std::string registered() const;  // "path uuid role"

  static constexpr const char* device_path = "/org/bluez/hci0/dev_00_1A_7D_DA_71_13";

 private:
  using Properties = std::map<std::string, sdbus::Variant>;
  using Reply = sdbus::Result<>;

  void export_adapter();
  void export_device();
  void register_profile(const std::string& path, const std::string& uuid, const Properties& options);
  void connect_profile(Reply&& reply, const std::string& uuid);
  [[nodiscard]] Script script() const;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Script script_;
  std::string client_;
  std::string profile_path_;
  std::string registered_;
  std::size_t asked_ = 0;
  std::shared_ptr<SocketPair> pair_;
  std::unique_ptr<sdbus::IConnection> connection_;
  std::unique_ptr<sdbus::IProxy> profile_;
  std::vector<std::shared_ptr<Reply>> unanswered_;
  std::unique_ptr<sdbus::IObject> root_;
  std::unique_ptr<sdbus::IObject> manager_;
  std::unique_ptr<sdbus::IObject> adapter_;
  std::unique_ptr<sdbus::IObject> device_;
};

}  // namespace telehug
