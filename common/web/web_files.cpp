// SPDX-License-Identifier: Apache-2.0
#include "web/web_files.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <stdexcept>
#include <utility>

namespace telehug {
namespace {

// FNV-1a (http://www.isthe.com/chongo/tech/comp/fnv): tells two versions of a file apart, and protects nothing.
std::uint64_t fingerprint(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3;
  }
  return hash;
}

}  // namespace

std::optional<std::string_view> web_type(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> types[] = {
      {".html", "text/html; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".json", "application/json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
  };
  for (const auto& [ending, type] : types)
    if (name.ends_with(ending)) return type;
  return std::nullopt;
}

WebFiles::WebFiles(std::initializer_list<std::span<const EmbeddedFile>> tables) {
  for (const auto& table : tables) {
    for (const EmbeddedFile& file : table) {
      const auto type = web_type(file.name);
      if (!type) throw std::invalid_argument(fmt::format("web: no type is known for \"{}\"", file.name));
      WebFile served{file.content, *type, fmt::format("\"{:016x}\"", fingerprint(file.content))};
      if (!files_.emplace(file.name, std::move(served)).second)
        throw std::invalid_argument(fmt::format("web: two files are called \"{}\"", file.name));
    }
  }
}

const WebFile* WebFiles::find(std::string_view path) const {
  if (!path.starts_with('/')) return nullptr;
  const auto file = files_.find(path == "/" ? "index.html" : path.substr(1));
  return file == files_.end() ? nullptr : &file->second;
}

}  // namespace telehug
