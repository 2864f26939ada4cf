// SPDX-License-Identifier: Apache-2.0
#include "doubles/drawn_screen.hpp"

#include <pipewire/pipewire.h>
#include <spa/param/video/format-utils.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace telehug {
namespace {

constexpr std::chrono::seconds longest_wait{10};

spa_video_format spa_format(DrawnScreen::Format format) {
  switch (format) {
    case DrawnScreen::Format::bgrx:
      return SPA_VIDEO_FORMAT_BGRx;
    case DrawnScreen::Format::bgra:
      return SPA_VIDEO_FORMAT_BGRA;
    case DrawnScreen::Format::rgbx:
      return SPA_VIDEO_FORMAT_RGBx;
    case DrawnScreen::Format::rgba:
      return SPA_VIDEO_FORMAT_RGBA;
  }
  return SPA_VIDEO_FORMAT_UNKNOWN;
}

}  // namespace

struct DrawnScreen::Parts {
  Settings settings;
  cv::Size agreed;  // empty: none now
  pw_thread_loop* loop = nullptr;
  pw_context* context = nullptr;
  pw_core* core = nullptr;
  pw_registry* registry = nullptr;
  pw_stream* stream = nullptr;
  spa_hook registry_listener{};
  spa_hook stream_listener{};
  std::vector<pw_proxy*> links;
  std::set<std::uint32_t> receivers;  // nodes

  int stride() const { return settings.size.width * 4 + settings.padding_bytes; }

  // With the loop locked.
  template <typename Condition>
  bool wait_for(Condition&& condition) {
    const auto deadline = std::chrono::steady_clock::now() + longest_wait;
    while (!condition()) {
      if (std::chrono::steady_clock::now() > deadline) return false;
      timespec until{};
      pw_thread_loop_get_time(loop, &until, 5 * SPA_NSEC_PER_MSEC);
      pw_thread_loop_timed_wait_full(loop, &until);
    }
    return true;
  }

  const spa_pod* build_format(spa_pod_builder& builder) const {
    const spa_rectangle size{static_cast<std::uint32_t>(settings.size.width),
                             static_cast<std::uint32_t>(settings.size.height)};
    const spa_fraction on_change{0, 1};
    const spa_fraction fastest{60, 1};
    const spa_fraction slowest{1, 1};
    return static_cast<const spa_pod*>(spa_pod_builder_add_object(
        &builder, SPA_TYPE_OBJECT_Format, SPA_PARAM_EnumFormat, SPA_FORMAT_mediaType, SPA_POD_Id(SPA_MEDIA_TYPE_video),
        SPA_FORMAT_mediaSubtype, SPA_POD_Id(SPA_MEDIA_SUBTYPE_raw), SPA_FORMAT_VIDEO_format,
        SPA_POD_Id(spa_format(settings.format)), SPA_FORMAT_VIDEO_size, SPA_POD_Rectangle(&size),
        SPA_FORMAT_VIDEO_framerate, SPA_POD_Fraction(&on_change), SPA_FORMAT_VIDEO_maxFramerate,
        SPA_POD_CHOICE_RANGE_Fraction(&fastest, &slowest, &fastest)));
  }

  void use_format(const spa_pod* param) {
    agreed = {};
    spa_video_info_raw raw{};
    if (param == nullptr || spa_format_video_raw_parse(param, &raw) < 0) return;
    agreed = cv::Size(static_cast<int>(raw.size.width), static_cast<int>(raw.size.height));
    set_buffers();
  }

  void set_buffers() {
    std::array<std::uint8_t, 1024> memory{};
    spa_pod_builder builder{};
    spa_pod_builder_init(&builder, memory.data(), static_cast<std::uint32_t>(memory.size()));
    const auto* buffers = static_cast<const spa_pod*>(spa_pod_builder_add_object(
        &builder, SPA_TYPE_OBJECT_ParamBuffers, SPA_PARAM_Buffers, SPA_PARAM_BUFFERS_buffers,
        SPA_POD_CHOICE_RANGE_Int(3, 2, 8), SPA_PARAM_BUFFERS_blocks, SPA_POD_Int(1), SPA_PARAM_BUFFERS_size,
        SPA_POD_Int(stride() * settings.size.height), SPA_PARAM_BUFFERS_stride, SPA_POD_Int(stride())));
    const auto* header = static_cast<const spa_pod*>(spa_pod_builder_add_object(
        &builder, SPA_TYPE_OBJECT_ParamMeta, SPA_PARAM_Meta, SPA_PARAM_META_type, SPA_POD_Id(SPA_META_Header),
        SPA_PARAM_META_size, SPA_POD_Int(static_cast<int>(sizeof(spa_meta_header)))));
    std::array<const spa_pod*, 2> params{buffers, header};
    pw_stream_update_params(stream, params.data(), static_cast<std::uint32_t>(params.size()));
  }

  // A node's port for pictures, of a stream that wants this node.
  void link_to(std::uint32_t receiver, std::uint32_t port) {
    const std::string output = std::to_string(pw_stream_get_node_id(stream));
    const std::string input = std::to_string(receiver);
    const std::string input_port = std::to_string(port);
    const std::array<spa_dict_item, 3> items{spa_dict_item{PW_KEY_LINK_OUTPUT_NODE, output.c_str()},
                                             spa_dict_item{PW_KEY_LINK_INPUT_NODE, input.c_str()},
                                             spa_dict_item{PW_KEY_LINK_INPUT_PORT, input_port.c_str()}};
    const spa_dict words{0, static_cast<std::uint32_t>(items.size()), items.data()};
    links.push_back(static_cast<pw_proxy*>(
        pw_core_create_object(core, "link-factory", PW_TYPE_INTERFACE_Link, PW_VERSION_LINK, &words, 0)));
  }

  void on_global(std::uint32_t id, const std::string& type, const spa_dict* words) {
    const auto word = [&](const char* key) {
      const char* found = words == nullptr ? nullptr : spa_dict_lookup(words, key);
      return std::string(found == nullptr ? "" : found);
    };
    if (type == PW_TYPE_INTERFACE_Node && word(PW_KEY_NODE_NAME) == "telehug-screen") receivers.insert(id);
    if (type != PW_TYPE_INTERFACE_Port || word(PW_KEY_PORT_DIRECTION) != "in") return;
    const auto node = static_cast<std::uint32_t>(std::strtoul(word(PW_KEY_NODE_ID).c_str(), nullptr, 10));
    if (receivers.contains(node)) link_to(node, id);
  }

  void fill(pw_buffer& buffer, const cv::Mat& bgrx) const {
    spa_data& data = buffer.buffer->datas[0];
    cv::Mat rows(settings.size, CV_8UC4, data.data, static_cast<std::size_t>(stride()));
    if (settings.format == Format::rgbx || settings.format == Format::rgba) {
      cv::cvtColor(bgrx, rows, cv::COLOR_BGRA2RGBA);
    } else {
      bgrx.copyTo(rows);
    }
    *data.chunk = {0, static_cast<std::uint32_t>(stride() * settings.size.height), stride(), 0};
  }
};

DrawnScreen::DrawnScreen(int pipewire_fd, Settings settings) : parts_(std::make_unique<Parts>()) {
  pw_init(nullptr, nullptr);
  Parts& parts = *parts_;
  parts.settings = settings;
  parts.loop = pw_thread_loop_new("drawn-screen", nullptr);
  parts.context = pw_context_new(pw_thread_loop_get_loop(parts.loop), nullptr, 0);
  pw_thread_loop_lock(parts.loop);
  pw_thread_loop_start(parts.loop);
  parts.core = pw_context_connect_fd(parts.context, pipewire_fd, nullptr, 0);
  if (parts.core == nullptr) throw std::runtime_error("the drawn screen can't connect to PipeWire");

  static const pw_registry_events registry_events = [] {
    pw_registry_events events{};
    events.version = PW_VERSION_REGISTRY_EVENTS;
    events.global = [](void* data, std::uint32_t id, std::uint32_t, const char* type, std::uint32_t,
                       const spa_dict* words) { static_cast<Parts*>(data)->on_global(id, type, words); };
    return events;
  }();
  static const pw_stream_events stream_events = [] {
    pw_stream_events events{};
    events.version = PW_VERSION_STREAM_EVENTS;
    events.state_changed = [](void* data, pw_stream_state, pw_stream_state, const char*) {
      pw_thread_loop_signal(static_cast<Parts*>(data)->loop, false);
    };
    events.param_changed = [](void* data, std::uint32_t id, const spa_pod* param) {
      if (id == SPA_PARAM_Format) static_cast<Parts*>(data)->use_format(param);
    };
    return events;
  }();
  parts.stream =
      pw_stream_new(parts.core, "drawn screen",
                    pw_properties_new(PW_KEY_MEDIA_CLASS, "Video/Source", PW_KEY_NODE_NAME, "drawn-screen", nullptr));
  pw_stream_add_listener(parts.stream, &parts.stream_listener, &stream_events, &parts);
  std::array<std::uint8_t, 1024> memory{};
  spa_pod_builder builder{};
  spa_pod_builder_init(&builder, memory.data(), static_cast<std::uint32_t>(memory.size()));
  const spa_pod* format = parts.build_format(builder);
  // NOLINTNEXTLINE(clang-analyzer-optin.core.EnumCastOutOfRange): a set of flags, as C makes it
  constexpr auto flags = static_cast<pw_stream_flags>(PW_STREAM_FLAG_DRIVER | PW_STREAM_FLAG_MAP_BUFFERS);
  pw_stream_connect(parts.stream, PW_DIRECTION_OUTPUT, PW_ID_ANY, flags, &format, 1);
  const bool ready =
      parts.wait_for([&] { return pw_stream_get_state(parts.stream, nullptr) == PW_STREAM_STATE_PAUSED; });
  parts.registry = pw_core_get_registry(parts.core, PW_VERSION_REGISTRY, 0);
  pw_registry_add_listener(parts.registry, &parts.registry_listener, &registry_events, &parts);
  pw_thread_loop_unlock(parts.loop);
  if (!ready) throw std::runtime_error("the drawn screen does not become a node of PipeWire");
}

DrawnScreen::~DrawnScreen() {
  Parts& parts = *parts_;
  pw_thread_loop_lock(parts.loop);
  for (pw_proxy* link : parts.links)
    pw_proxy_destroy(link);
  pw_proxy_destroy(reinterpret_cast<pw_proxy*>(parts.registry));
  pw_stream_destroy(parts.stream);
  pw_core_disconnect(parts.core);
  pw_thread_loop_unlock(parts.loop);
  pw_thread_loop_stop(parts.loop);
  pw_context_destroy(parts.context);
  pw_thread_loop_destroy(parts.loop);
}

std::uint32_t DrawnScreen::node() const {
  return pw_stream_get_node_id(parts_->stream);
}

bool DrawnScreen::is_watched() {
  Parts& parts = *parts_;
  pw_thread_loop_lock(parts.loop);
  const bool streams =
      parts.wait_for([&] { return pw_stream_get_state(parts.stream, nullptr) == PW_STREAM_STATE_STREAMING; });
  pw_thread_loop_unlock(parts.loop);
  return streams;
}

bool DrawnScreen::show(const cv::Mat& bgrx, const std::function<void(spa_chunk&)>& lie) {
  if (!is_watched()) return false;
  Parts& parts = *parts_;
  pw_thread_loop_lock(parts.loop);
  pw_buffer* buffer = nullptr;
  // A buffer comes back with the cycle after the one in which it was used.
  const bool free = parts.wait_for([&] {
    if (parts.agreed != bgrx.size()) return false;
    buffer = pw_stream_dequeue_buffer(parts.stream);
    if (buffer == nullptr) pw_stream_trigger_process(parts.stream);
    return buffer != nullptr;
  });
  if (free) {
    parts.fill(*buffer, bgrx);
    if (lie) lie(*buffer->buffer->datas[0].chunk);
    pw_stream_queue_buffer(parts.stream, buffer);
    pw_stream_trigger_process(parts.stream);
  }
  pw_thread_loop_unlock(parts.loop);
  return free;
}

void DrawnScreen::nudge() {
  pw_thread_loop_lock(parts_->loop);
  pw_stream_trigger_process(parts_->stream);
  pw_thread_loop_unlock(parts_->loop);
}

void DrawnScreen::resize(cv::Size size) {
  Parts& parts = *parts_;
  pw_thread_loop_lock(parts.loop);
  parts.settings.size = size;
  std::array<std::uint8_t, 1024> memory{};
  spa_pod_builder builder{};
  spa_pod_builder_init(&builder, memory.data(), static_cast<std::uint32_t>(memory.size()));
  const spa_pod* format = parts.build_format(builder);
  pw_stream_update_params(parts.stream, &format, 1);
  pw_thread_loop_unlock(parts.loop);
}

cv::Size DrawnScreen::size() const {
  pw_thread_loop_lock(parts_->loop);
  const cv::Size size = parts_->agreed;
  pw_thread_loop_unlock(parts_->loop);
  return size;
}

}  // namespace telehug
