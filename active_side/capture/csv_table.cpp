// SPDX-License-Identifier: Apache-2.0
#include "capture/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

namespace telehug {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> cells;
  while (true) {
    const auto comma = line.find(',');
    cells.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

template <typename Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& path, const std::vector<std::string>& columns,
                   std::vector<std::string>& faults, const std::vector<std::string>& optional)
    : path_(path), columns_(columns), faults_(faults) {
  columns_.insert(columns_.end(), optional.begin(), optional.end());
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) {
    add_line_fault(1,
                   fmt::format("the file can't be read or is empty; expected the columns {}", fmt::join(columns, ",")));
    return;
  }
  const std::vector<std::string> header = split(line);
  std::vector<std::size_t> places;
  bool complete = true;
  for (const std::string& column : columns_) {
    const auto found = std::find(header.begin(), header.end(), column);
    places.push_back(static_cast<std::size_t>(found - header.begin()));
    if (found != header.end() || places.size() > columns.size()) continue;
    add_line_fault(1, fmt::format("column '{}' is missing", column));
    complete = false;
  }
  if (!complete) return;

  for (int number = 2; std::getline(file, line); ++number) {
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> cells = split(line);
    if (cells.size() != header.size()) {
      add_line_fault(number,
                     fmt::format("{} values where the first line names {} columns", cells.size(), header.size()));
      continue;
    }
    Row row{number, {}};
    for (const std::size_t place : places)
      row.cells.push_back(place < cells.size() ? cells[place] : "");
    rows_.push_back(std::move(row));
  }
}

std::optional<double> CsvTable::number(std::size_t row, std::size_t column) {
  const auto value = parse<double>(text(row, column));
  if (value && std::isfinite(*value)) return value;
  add_fault(row, fmt::format("{} is '{}', which is not a number", columns_[column], text(row, column)));
  return std::nullopt;
}

std::optional<std::int64_t> CsvTable::integer(std::size_t row, std::size_t column) {
  const auto value = parse<std::int64_t>(text(row, column));
  if (!value)
    add_fault(row, fmt::format("{} is '{}', which is not a whole number", columns_[column], text(row, column)));
  return value;
}

void CsvTable::add_fault(std::size_t row, std::string_view what) {
  add_line_fault(rows_[row].line, what);
}

void CsvTable::add_line_fault(int line, std::string_view what) {
  faults_.push_back(fmt::format("{}:{}: {}", path_.string(), line, what));
}

}  // namespace telehug
