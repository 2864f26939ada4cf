// SPDX-License-Identifier: Apache-2.0
//
// A TUIO client: what liblo's own server reads from the bytes that came over the loopback interface.
#pragma once

#include <lo/lo.h>

#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace telehug {

// A listener on a port that the kernel chooses.
class TuioListener {
 public:
  struct Bundle {
    std::string source;
    std::vector<int> alive;
    std::map<int, std::vector<float>> set;
    int fseq = 0;
  };

  TuioListener() : server_(lo_server_new_with_proto(nullptr, LO_UDP, nullptr)) {
    lo_server_add_method(server_, "/tuio/2Dcur", nullptr, &TuioListener::take, this);
  }
  ~TuioListener() { lo_server_free(server_); }
  TuioListener(const TuioListener&) = delete;
  TuioListener& operator=(const TuioListener&) = delete;

  [[nodiscard]] int port() const { return lo_server_get_port(server_); }

  // Bundles that have come; on the loopback interface they are there when they were sent.
  std::vector<Bundle> bundles() {
    while (lo_server_recv_noblock(server_, bundles_.empty() ? 2000 : 0) > 0) {
    }
    return std::exchange(bundles_, {});
  }
  [[nodiscard]] bool silent() { return lo_server_recv_noblock(server_, 0) == 0; }

 private:
  // OSC aligns to 4 bytes, liblo's lo_arg asks for 8: its members must not be read where they lie.
  static const char* text_of(const lo_arg* value) { return reinterpret_cast<const char*>(value); }
  template <typename T>
  static T number_of(const lo_arg* value) {
    T number{};
    std::memcpy(&number, static_cast<const void*>(value), sizeof(number));
    return number;
  }
  static int take(const char* /*path*/, const char* types, lo_arg** values, int count, lo_message /*message*/,
                  void* listener) {
    static_cast<TuioListener*>(listener)->take(types, values, count);
    return 0;
  }
  void take(const std::string& types, lo_arg** values, int count) {
    const std::string kind = text_of(values[0]);
    if (kind == "source") now_.source = types == "ss" ? text_of(values[1]) : "wrong types " + types;
    for (int i = 1; kind == "alive" && i < count; ++i)
      now_.alive.push_back(number_of<int>(values[i]));
    if (kind == "set" && types == "sifffff") {
      for (int i = 2; i < count; ++i)
        now_.set[number_of<int>(values[1])].push_back(number_of<float>(values[i]));
    }
    if (kind != "fseq") return;
    now_.fseq = number_of<int>(values[1]);
    bundles_.push_back(std::exchange(now_, {}));
  }

  lo_server server_;
  Bundle now_;
  std::vector<Bundle> bundles_;
};

}  // namespace telehug
