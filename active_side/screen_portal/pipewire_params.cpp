// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/pipewire_params.hpp"

#include <pipewire/pipewire.h>
#include <spa/param/video/format-utils.h>

#include <array>

namespace telehug {
namespace {

// More often nobody looks, and each picture costs the desktop a copy out of the graphics card.
constexpr std::uint32_t most_frames_a_second = 15;

// `limit_rate`: also ask not to be sent more frames than are looked at. A desktop whose rate is fixed can't do that.
const spa_pod* build_format(spa_pod_builder& builder, bool limit_rate) {
  const spa_rectangle usual{1920, 1080};
  const spa_rectangle smallest{1, 1};
  const spa_rectangle largest{longest_screen_side_px, longest_screen_side_px};
  const spa_fraction on_change{0, 1};
  const spa_fraction fastest{1000, 1};
  const spa_fraction slowest_limit{1, 1};
  const spa_fraction limit{most_frames_a_second, 1};
  spa_pod_frame frame{};
  spa_pod_builder_push_object(&builder, &frame, SPA_TYPE_OBJECT_Format, SPA_PARAM_EnumFormat);
  spa_pod_builder_add(&builder, SPA_FORMAT_mediaType, SPA_POD_Id(SPA_MEDIA_TYPE_video), SPA_FORMAT_mediaSubtype,
                      SPA_POD_Id(SPA_MEDIA_SUBTYPE_raw), SPA_FORMAT_VIDEO_format,
                      SPA_POD_CHOICE_ENUM_Id(5, SPA_VIDEO_FORMAT_BGRx, SPA_VIDEO_FORMAT_BGRx, SPA_VIDEO_FORMAT_BGRA,
                                             SPA_VIDEO_FORMAT_RGBx, SPA_VIDEO_FORMAT_RGBA),
                      SPA_FORMAT_VIDEO_size, SPA_POD_CHOICE_RANGE_Rectangle(&usual, &smallest, &largest),
                      SPA_FORMAT_VIDEO_framerate, SPA_POD_CHOICE_RANGE_Fraction(&on_change, &on_change, &fastest), 0);
  if (limit_rate) {
    spa_pod_builder_add(&builder, SPA_FORMAT_VIDEO_maxFramerate,
                        SPA_POD_CHOICE_RANGE_Fraction(&limit, &slowest_limit, &limit), 0);
  }
  return static_cast<const spa_pod*>(spa_pod_builder_pop(&builder, &frame));
}

const spa_pod* build_meta(spa_pod_builder& builder, spa_meta_type type, std::size_t size) {
  return static_cast<const spa_pod*>(
      spa_pod_builder_add_object(&builder, SPA_TYPE_OBJECT_ParamMeta, SPA_PARAM_Meta, SPA_PARAM_META_type,
                                 SPA_POD_Id(type), SPA_PARAM_META_size, SPA_POD_Int(static_cast<int>(size))));
}

}  // namespace

int connect_to_screen(pw_stream* stream, std::uint32_t node) {
  std::array<std::uint8_t, 2048> memory{};
  spa_pod_builder builder{};
  spa_pod_builder_init(&builder, memory.data(), static_cast<std::uint32_t>(memory.size()));
  std::array<const spa_pod*, 2> params{build_format(builder, true), build_format(builder, false)};
  // NOLINTNEXTLINE(clang-analyzer-optin.core.EnumCastOutOfRange): a set of flags, as C makes it
  constexpr auto flags = static_cast<pw_stream_flags>(PW_STREAM_FLAG_AUTOCONNECT | PW_STREAM_FLAG_MAP_BUFFERS |
                                                      PW_STREAM_FLAG_DONT_RECONNECT);
  // The portal names the node by its id; a name or serial is not to be had here.
  return pw_stream_connect(stream, PW_DIRECTION_INPUT, node, flags, params.data(),
                           static_cast<std::uint32_t>(params.size()));
}

std::optional<StreamFormat> read_format(const spa_pod* param) {
  std::uint32_t type = 0;
  std::uint32_t subtype = 0;
  spa_video_info_raw raw{};
  if (spa_format_parse(param, &type, &subtype) < 0 || type != SPA_MEDIA_TYPE_video ||
      subtype != SPA_MEDIA_SUBTYPE_raw || spa_format_video_raw_parse(param, &raw) < 0) {
    return std::nullopt;
  }
  if (raw.size.width == 0 || raw.size.height == 0 || raw.size.width > longest_screen_side_px ||
      raw.size.height > longest_screen_side_px) {
    return std::nullopt;
  }
  StreamFormat format;
  format.size = {.width_px = static_cast<int>(raw.size.width), .height_px = static_cast<int>(raw.size.height)};
  switch (raw.format) {
    case SPA_VIDEO_FORMAT_BGRx:
    case SPA_VIDEO_FORMAT_BGRA:
      format.order = PixelOrder::bgrx;
      return format;
    case SPA_VIDEO_FORMAT_RGBx:
    case SPA_VIDEO_FORMAT_RGBA:
      format.order = PixelOrder::rgbx;
      return format;
    default:
      return std::nullopt;
  }
}

void accept_buffers(pw_stream* stream) {
  std::array<std::uint8_t, 1024> memory{};
  spa_pod_builder builder{};
  spa_pod_builder_init(&builder, memory.data(), static_cast<std::uint32_t>(memory.size()));
  const auto* buffers = static_cast<const spa_pod*>(spa_pod_builder_add_object(
      &builder, SPA_TYPE_OBJECT_ParamBuffers, SPA_PARAM_Buffers, SPA_PARAM_BUFFERS_buffers,
      SPA_POD_CHOICE_RANGE_Int(4, 1, 16), SPA_PARAM_BUFFERS_blocks, SPA_POD_Int(1), SPA_PARAM_BUFFERS_dataType,
      SPA_POD_CHOICE_FLAGS_Int((1 << SPA_DATA_MemPtr) | (1 << SPA_DATA_MemFd))));
  std::array<const spa_pod*, 3> params{buffers, build_meta(builder, SPA_META_Header, sizeof(spa_meta_header)),
                                       build_meta(builder, SPA_META_VideoTransform, sizeof(spa_meta_videotransform))};
  pw_stream_update_params(stream, params.data(), static_cast<std::uint32_t>(params.size()));
}

}  // namespace telehug
