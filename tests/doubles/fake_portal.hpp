// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sdbus-c++/sdbus-c++.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace telehug {

using PortalWords = std::map<std::string, sdbus::Variant>;
using PortalNodes = std::vector<sdbus::Struct<std::uint32_t, PortalWords>>;

// A desktop's portal as org.freedesktop.portal.ScreenCast describes it, with a user who does as the script says.
class FakePortal {
 public:
  struct Script {
    std::uint32_t version = 4;
    std::uint32_t source_types = 3;
    std::uint32_t cursor_modes = 7;
    bool can_share_screens = true;
    bool chooses_paths = false;   // of the requests, as portals did before version 0.9
    bool user_hesitates = false;  // until answer()
    std::uint32_t user_says = 0;  // 0 yes, 1 no, 2 ended
    std::uint32_t node = 0;
    std::string token = "first-token";         // what it gives; empty: none
    std::optional<std::string> good_token;     // none: any is
    bool bad_token_is_an_error = false;        // or the end of the dialogue
    std::function<int()> connect_to_pipewire;  // none, or a negative result: an error
    // In place of the right answers; they write the signal's arguments.
    std::function<void(sdbus::Signal&)> answer_create;
    std::function<void(sdbus::Signal&)> answer_select;
    std::function<void(sdbus::Signal&)> answer_start;
  };

  struct Seen {
    int starts = 0;
    PortalWords select;               // the newest options
    std::vector<std::string> closed;  // paths of sessions and requests that were closed
  };

  FakePortal(const std::string& bus_address, Script script);
  ~FakePortal();
  FakePortal(const FakePortal&) = delete;
  FakePortal& operator=(const FakePortal&) = delete;

  // What happens from now on.
  void rewrite(const std::function<void(Script&)>& change);

  // The user, who hesitated, answers.
  void answer();

  // The user ends the sharing at the desktop.
  void end_session();

  // The path of the request that the user, who hesitates, has not answered.
  [[nodiscard]] std::string waiting_request() const;

  [[nodiscard]] Seen seen() const;

  // Waits until it has seen what is wanted.
  bool has_seen(const std::function<bool(const Seen&)>& wanted) const;

 private:
  using Reply = sdbus::Result<sdbus::ObjectPath>;
  using Answer = std::function<void(sdbus::Signal&)>;

  void export_screen_cast();
  void create(Reply&& reply, const PortalWords& options);
  void select(Reply&& reply, const PortalWords& options);
  void start(Reply&& reply, const PortalWords& options);
  std::string path_for(const char* kind, const PortalWords& options, const char* key) const;
  std::string add_request(const PortalWords& options);
  void respond(const std::string& request, const Answer& answer);
  void add_closable(const std::string& path, const char* interface);
  void note(const std::function<void(Seen&)>& what);
  [[nodiscard]] Script script() const;
  [[nodiscard]] Answer start_answer() const;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Script script_;
  Seen seen_;
  std::string session_;
  std::string waiting_;  // the request that the user has not answered

  std::unique_ptr<sdbus::IConnection> connection_;
  std::unique_ptr<sdbus::IObject> desktop_;
  std::vector<std::unique_ptr<sdbus::IObject>> objects_;  // sessions and requests
  std::map<std::string, sdbus::IObject*> by_path_;
};

}  // namespace telehug
