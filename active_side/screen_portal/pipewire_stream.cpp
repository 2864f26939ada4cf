// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/pipewire_stream.hpp"

#include <fmt/format.h>
#include <pipewire/pipewire.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <optional>
#include <utility>

#include "screen_portal/pipewire_params.hpp"

namespace telehug {
namespace {

// Once in a process; PipeWire can't be started again after it was ended.
void start_pipewire() {
  static const bool started = [] {
    pw_init(nullptr, nullptr);
    return true;
  }();
  static_cast<void>(started);
}

// Memory in a file that is shorter than it is said to be kills who reads it.
bool lies_in_its_file(const spa_data& data) {
  if (data.type == SPA_DATA_MemPtr) return true;
  struct stat file {};
  return data.type == SPA_DATA_MemFd && data.fd >= 0 && ::fstat(static_cast<int>(data.fd), &file) == 0 &&
         file.st_size >= std::int64_t{data.mapoffset} + std::int64_t{data.maxsize};
}

bool is_marked_corrupted(const spa_buffer& buffer) {
  const auto* header =
      static_cast<const spa_meta_header*>(spa_buffer_find_meta_data(&buffer, SPA_META_Header, sizeof(spa_meta_header)));
  return header != nullptr && (header->flags & SPA_META_HEADER_FLAG_CORRUPTED) != 0;
}

bool is_turned(const spa_buffer& buffer) {
  const auto* turn = static_cast<const spa_meta_videotransform*>(
      spa_buffer_find_meta_data(&buffer, SPA_META_VideoTransform, sizeof(spa_meta_videotransform)));
  return turn != nullptr && turn->transform != SPA_META_TRANSFORMATION_None;
}

struct StreamEnd {
  void operator()(pw_stream* stream) const { pw_stream_destroy(stream); }
};
struct CoreEnd {
  void operator()(pw_core* core) const { pw_core_disconnect(core); }
};
struct ContextEnd {
  void operator()(pw_context* context) const { pw_context_destroy(context); }
};
struct LoopEnd {
  void operator()(pw_loop* loop) const {
    pw_loop_leave(loop);
    pw_loop_destroy(loop);
  }
};

}  // namespace

struct PipeWireStream::Parts {
  explicit Parts(FrameSlot& frames) : slot(frames) {}

  void connect(int pipewire_fd, std::uint32_t node);
  void fail(const char* doing, const char* why);
  void use_format(const spa_pod* param);
  void use_newest_buffer();
  void use(pw_buffer* buffer);

  static void on_core_error(void* data, std::uint32_t id, int seq, int code, const char* message);
  static void on_state(void* data, pw_stream_state old, pw_stream_state now, const char* error);
  static void on_param(void* data, std::uint32_t id, const spa_pod* param);
  static void on_remove_buffer(void* data, pw_buffer* buffer);
  static void on_process(void* data);

  FrameSlot& slot;
  State state = State::waiting;
  std::string failure;
  std::optional<StreamFormat> format;

  // In this order: what stands below needs what stands above.
  std::unique_ptr<pw_loop, LoopEnd> loop;
  std::unique_ptr<pw_context, ContextEnd> context;
  std::unique_ptr<pw_core, CoreEnd> core;
  spa_hook core_listener{};
  std::unique_ptr<pw_stream, StreamEnd> stream;
  spa_hook stream_listener{};
};

void PipeWireStream::Parts::connect(int pipewire_fd, std::uint32_t node) {
  start_pipewire();
  loop.reset(pw_loop_new(nullptr));
  if (loop) pw_loop_enter(loop.get());
  if (loop) context.reset(pw_context_new(loop.get(), nullptr, 0));
  if (!context) {
    ::close(pipewire_fd);
    return fail("can't be used", "are the packages pipewire-bin and libpipewire-0.3-modules installed?");
  }
  core.reset(pw_context_connect_fd(context.get(), pipewire_fd, nullptr, 0));  // closes it, whatever comes
  if (!core) return fail("can't be reached", std::strerror(errno));
  static const pw_core_events core_events = [] {
    pw_core_events events{};
    events.version = PW_VERSION_CORE_EVENTS;
    events.error = on_core_error;
    return events;
  }();
  pw_core_add_listener(core.get(), &core_listener, &core_events, this);

  stream.reset(
      pw_stream_new(core.get(), "telehug",
                    pw_properties_new(PW_KEY_MEDIA_TYPE, "Video", PW_KEY_MEDIA_CATEGORY, "Capture", PW_KEY_MEDIA_ROLE,
                                      "Screen", PW_KEY_NODE_NAME, "telehug-screen", nullptr)));
  if (!stream) return fail("gives no stream", std::strerror(errno));
  static const pw_stream_events stream_events = [] {
    pw_stream_events events{};
    events.version = PW_VERSION_STREAM_EVENTS;
    events.state_changed = on_state;
    events.param_changed = on_param;
    events.remove_buffer = on_remove_buffer;
    events.process = on_process;
    return events;
  }();
  pw_stream_add_listener(stream.get(), &stream_listener, &stream_events, this);
  const int code = connect_to_screen(stream.get(), node);
  if (code < 0) fail("gives no picture", std::strerror(-code));
}

void PipeWireStream::Parts::fail(const char* doing, const char* why) {
  if (state == State::failed) return;
  state = State::failed;
  failure = fmt::format(
      "PipeWire, which carries the picture of the screen, {} ({}); see systemctl --user status "
      "pipewire.",
      doing, why);
}

void PipeWireStream::Parts::on_core_error(void* data, std::uint32_t id, int /*seq*/, int code,
                                          const char* /*message*/) {
  if (id == PW_ID_CORE) static_cast<Parts*>(data)->fail("has ended the connection", std::strerror(-code));
}

void PipeWireStream::Parts::on_state(void* data, pw_stream_state /*old*/, pw_stream_state now, const char* error) {
  auto& parts = *static_cast<Parts*>(data);
  if (parts.state == State::failed) return;
  if (now == PW_STREAM_STATE_ERROR) return parts.fail("gives no picture", error == nullptr ? "no reason" : error);
  if (now == PW_STREAM_STATE_UNCONNECTED) return parts.fail("gives no picture any more", "it was disconnected");
  parts.state = now == PW_STREAM_STATE_STREAMING ? State::flowing : State::waiting;
}

void PipeWireStream::Parts::on_param(void* data, std::uint32_t id, const spa_pod* param) {
  if (id == SPA_PARAM_Format) static_cast<Parts*>(data)->use_format(param);
}

void PipeWireStream::Parts::use_format(const spa_pod* param) {
  format.reset();
  slot.clear();  // the buffers go away with the format
  if (param == nullptr) return;
  format = read_format(param);
  if (format) {
    accept_buffers(stream.get());
  } else {
    pw_stream_set_error(stream.get(), -EINVAL, "the screen comes in a format that was not asked for");
  }
}

void PipeWireStream::Parts::on_remove_buffer(void* data, pw_buffer* buffer) {
  const spa_buffer& memory = *buffer->buffer;
  if (memory.n_datas > 0)
    static_cast<Parts*>(data)->slot.remove(static_cast<const std::uint8_t*>(memory.datas[0].data));
}

void PipeWireStream::Parts::on_process(void* data) {
  static_cast<Parts*>(data)->use_newest_buffer();
}

void PipeWireStream::Parts::use_newest_buffer() {
  while (pw_buffer* buffer = pw_stream_dequeue_buffer(stream.get()))
    use(buffer);
}

void PipeWireStream::Parts::use(pw_buffer* buffer) {
  const auto give_back = [from = stream.get(), buffer] { pw_stream_queue_buffer(from, buffer); };
  const spa_buffer& memory = *buffer->buffer;
  if (!format || memory.n_datas == 0 || memory.datas[0].chunk == nullptr) return slot.skip(give_back);
  const spa_data& data = memory.datas[0];
  const spa_chunk chunk = *data.chunk;  // once: the other program could write to it meanwhile
  // Nothing new to see: desktops tell like that that only the mouse has moved.
  if (chunk.size == 0 || (static_cast<unsigned>(chunk.flags) & SPA_CHUNK_FLAG_CORRUPTED) != 0 ||
      is_marked_corrupted(memory)) {
    return slot.skip(give_back);
  }
  if (is_turned(memory)) return slot.spoil("the monitor is turned or mirrored; set it upright", give_back);
  if (!lies_in_its_file(data)) return slot.spoil("it lies outside of its memory", give_back);
  slot.put({.data = static_cast<const std::uint8_t*>(data.data),
            .bytes = data.maxsize,
            .offset = chunk.offset,
            .filled = chunk.size,
            .stride = chunk.stride,
            .size = format->size,
            .order = format->order},
           give_back);
}

PipeWireStream::PipeWireStream(int pipewire_fd, std::uint32_t node, FrameSlot& slot)
    : parts_(std::make_unique<Parts>(slot)) {
  parts_->connect(pipewire_fd, node);
}

PipeWireStream::~PipeWireStream() {
  parts_->slot.clear();  // before the buffers end
}

int PipeWireStream::fd() const {
  return parts_->state == State::failed ? -1 : pw_loop_get_fd(parts_->loop.get());
}

void PipeWireStream::process() {
  if (parts_->state != State::failed) pw_loop_iterate(parts_->loop.get(), 0);
}

PipeWireStream::State PipeWireStream::state() const {
  return parts_->state;
}

const std::string& PipeWireStream::failure() const {
  return parts_->failure;
}

}  // namespace telehug
