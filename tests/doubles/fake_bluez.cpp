// SPDX-License-Identifier: Apache-2.0
#include "doubles/fake_bluez.hpp"

namespace telehug {
namespace {

constexpr const char* service = "org.bluez";
constexpr const char* serial_port = "00001101-0000-1000-8000-00805f9b34fb";

}  // namespace

FakeBluez::FakeBluez(const std::string& bus_address, Script script)
    : script_(std::move(script)), connection_(sdbus::createSessionBusConnectionWithAddress(bus_address)) {
  root_ = sdbus::createObject(*connection_, "/");
  root_->addObjectManager();
  root_->finishRegistration();
  manager_ = sdbus::createObject(*connection_, "/org/bluez");
  manager_->registerMethod("RegisterProfile")
      .onInterface("org.bluez.ProfileManager1")
      .implementedAs([this](const sdbus::ObjectPath& path, const std::string& uuid, const Properties& options) {
        register_profile(path, uuid, options);
      });
  manager_->finishRegistration();
  export_adapter();
  export_device();
  connection_->requestName(service);
  connection_->enterEventLoopAsync();
}

FakeBluez::~FakeBluez() {
  connection_->leaveEventLoop();
  connection_->releaseName(service);  // waits for it: the next one shall get it
}

void FakeBluez::rewrite(const std::function<void(Script&)>& change) {
  {
    const std::lock_guard lock(mutex_);
    change(script_);
  }
  export_adapter();
  export_device();
}

FakeBluez::Script FakeBluez::script() const {
  const std::lock_guard lock(mutex_);
  return script_;
}

bool FakeBluez::was_asked(std::size_t times) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, 10s, [&] { return asked_ >= times; });
}

std::shared_ptr<SocketPair> FakeBluez::connection() const {
  const std::lock_guard lock(mutex_);
  return pair_;
}

std::string FakeBluez::registered() const {
  const std::lock_guard lock(mutex_);
  return registered_;
}

void FakeBluez::export_adapter() {
  adapter_.reset();
  if (!script().has_adapter) return;
  constexpr const char* interface = "org.bluez.Adapter1";
  adapter_ = sdbus::createObject(*connection_, "/org/bluez/hci0");
  adapter_->registerProperty("Address").onInterface(interface).withGetter(
      [] { return std::string("00:00:00:00:00:01"); });
  adapter_->registerProperty("Class").onInterface(interface).withGetter([] { return std::uint32_t{0x104}; });
  adapter_->registerProperty("Powered").onInterface(interface).withGetter([this] { return script().powered; });
  adapter_->finishRegistration();
}

void FakeBluez::export_device() {
  device_.reset();
  if (!script().knows_device) return;
  constexpr const char* interface = "org.bluez.Device1";
  device_ = sdbus::createObject(*connection_, device_path);
  device_->registerProperty("Address").onInterface(interface).withGetter(
      [] { return std::string("00:1A:7D:DA:71:13"); });
  device_->registerProperty("RSSI").onInterface(interface).withGetter([] { return std::int16_t{-60}; });
  device_->registerProperty("Paired").onInterface(interface).withGetter([this] { return script().paired; });
  device_->registerProperty("Connected").onInterface(interface).withGetter([this] { return script().connected; });
  device_->registerProperty("UUIDs").onInterface(interface).withGetter([this] { return script().uuids; });
  device_->registerMethod("ConnectProfile")
      .onInterface(interface)
      .implementedAs([this](Reply&& reply, const std::string& uuid) { connect_profile(std::move(reply), uuid); });
  device_->finishRegistration();
}

void FakeBluez::register_profile(const std::string& path, const std::string& uuid, const Properties& options) {
  if (const std::string error = script().registering_fails; !error.empty()) throw sdbus::Error(error, "no");
  const std::lock_guard lock(mutex_);
  client_ = manager_->getCurrentlyProcessedMessage()->getSender();
  profile_path_ = path;
  registered_ = path + " " + uuid + " " + options.at("Role").get<std::string>();
}

void FakeBluez::connect_profile(Reply&& reply, const std::string& uuid) {
  const Script now = script();
  auto answer = std::make_shared<Reply>(std::move(reply));
  const std::lock_guard lock(mutex_);
  ++asked_;
  changed_.notify_all();
  if (!now.answers) {
    unanswered_.push_back(answer);
    return;
  }
  if (uuid != serial_port) return answer->returnError(sdbus::Error("org.bluez.Error.InvalidArguments", uuid));
  if (!now.connecting_fails.empty()) {
    const auto colon = now.connecting_fails.find(": ");
    return answer->returnError(
        sdbus::Error(now.connecting_fails.substr(0, colon), now.connecting_fails.substr(colon + 2)));
  }
  if (!now.hands_over) return answer->returnResults();
  pair_ = std::make_shared<SocketPair>();
  profile_ = sdbus::createProxy(*connection_, client_, profile_path_);
  profile_->callMethodAsync("NewConnection")
      .onInterface("org.bluez.Profile1")
      .withArguments(sdbus::ObjectPath(now.wrong_device.empty() ? device_path : now.wrong_device),
                     sdbus::UnixFd(pair_->give(), sdbus::adopt_fd), Properties{})
      .uponReplyInvoke([answer](const sdbus::Error* error) {
        if (error == nullptr) return answer->returnResults();
        answer->returnError(sdbus::Error("org.bluez.Error.Failed", "rejected"));
      });
}

}  // namespace telehug
