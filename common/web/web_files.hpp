// SPDX-License-Identifier: Apache-2.0
//
// The files of the pages, embedded at build time (cmake/WebFiles.cmake). A name is looked up in a table and nowhere
// else: there is no file system behind it.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace telehug {

// As the generated tables hold them; both live as long as the program.
struct EmbeddedFile {
  std::string_view name;  // "index.html", "texts/de.json"
  std::string_view content;
};

struct WebFile {
  std::string_view content;
  std::string_view type;  // of HTTP's Content-Type
  std::string etag;       // with its quotation marks; changes with the content
};

class WebFiles {
 public:
  // Throws std::invalid_argument for a name that comes twice, or of a kind for which no type is known.
  explicit WebFiles(std::initializer_list<std::span<const EmbeddedFile>> tables);

  // `path` of a request, as it came: "/index.html"; "/" is that, too. Null if there is none of exactly this name.
  [[nodiscard]] const WebFile* find(std::string_view path) const;

 private:
  std::map<std::string_view, WebFile> files_;
};

// By the name's ending; nothing if it is not known.
[[nodiscard]] std::optional<std::string_view> web_type(std::string_view name);

}  // namespace telehug
