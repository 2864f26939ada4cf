// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "child_process.hpp"
#include "service/control_client.hpp"

namespace telehug {

struct DemoSettings {
  std::filesystem::path programs;  // folder of telehug-active and the others
  std::string source;              // replay:DIR or virtual
  std::filesystem::path chat_picture;
  std::filesystem::path profile;
  std::string active_level = "warn";  // of the logs
};

// Both daemons as real processes on loopback, with a simulated jacket, in a folder and a DDS partition of their own.
class DemoWorld {
 public:
  // Starts the jacket and the passive side, calibrates, and waits until the jacket is ready. Throws std::runtime_error
  // with the reason and the log's place.
  explicit DemoWorld(const DemoSettings& settings);
  ~DemoWorld();
  DemoWorld(const DemoWorld&) = delete;
  DemoWorld& operator=(const DemoWorld&) = delete;

  // Starts the active side: touches begin soon after.
  void start_active();

  // The daemons' local sockets.
  [[nodiscard]] ControlClient connect_to_active() const { return connect(active_socket_); }
  [[nodiscard]] ControlClient connect_to_passive() const { return connect(passive_socket_); }

  // Throws if a program has ended by itself.
  void check_all_run();

  // Ends all programs, the jacket last. False if one did not end as it should.
  bool end();

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  [[nodiscard]] std::filesystem::path pins() const { return folder_ / "pins.csv"; }
  void keep_folder() noexcept { keep_ = true; }

 private:
  [[nodiscard]] ControlClient connect(const std::filesystem::path& socket) const;
  [[nodiscard]] std::string program(const std::string& name) const { return settings_.programs / name; }
  [[nodiscard]] std::vector<std::string> peer_settings() const;
  void calibrate() const;
  void wait_for_jacket() const;

  DemoSettings settings_;
  std::filesystem::path folder_;
  std::filesystem::path active_socket_;
  std::filesystem::path passive_socket_;
  std::string partition_;
  bool keep_ = false;
  std::unique_ptr<ChildProcess> jacket_;
  std::unique_ptr<ChildProcess> passive_;
  std::unique_ptr<ChildProcess> active_;
};

}  // namespace telehug
