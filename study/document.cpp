// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/document.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"
#include "study/table_reader.hpp"
#include <algorithm>
#include <sstream>
#include <toml++/toml.h>

namespace fretwork::study {
namespace {

constexpr int deepest = 64;                                     ///< levels; the keys of a study have six
constexpr std::uintmax_t most_bytes = std::uintmax_t{16} << 20; ///< of a study: a hundred thousand entries

class Converter {
public:
  Converter(std::shared_ptr<const std::string> origin, Lines lines)
      : origin_(std::move(origin)), lines_(lines) {}

  [[nodiscard]] Value operator()(const toml::node& node) const {
    Value out;
    out.where = {origin_, lines_ == Lines::kept ? static_cast<int>(node.source().begin.line) : 0};
    switch (node.type()) {
    case toml::node_type::boolean:
      out.data = node.as_boolean()->get();
      break;
    case toml::node_type::integer:
      out.data = node.as_integer()->get();
      break;
    case toml::node_type::floating_point:
      out.data = node.as_floating_point()->get();
      break;
    case toml::node_type::string:
      out.data = node.as_string()->get();
      break;
    case toml::node_type::date:
      out.data = moment(node.as_date()->get());
      break;
    case toml::node_type::time:
      out.data = moment(node.as_time()->get());
      break;
    case toml::node_type::date_time:
      out.data = moment(node.as_date_time()->get());
      break;
    case toml::node_type::array:
      out.data = array(*node.as_array());
      break;
    case toml::node_type::table:
    case toml::node_type::none: // no node of a parsed document is of this type
      out.data = table(*node.as_table());
      break;
    }
    return out;
  }

private:
  template <class T> [[nodiscard]] static Moment moment(const T& value) {
    std::ostringstream text;
    text << value;
    return {text.str()};
  }
  [[nodiscard]] Array array(const toml::array& items) const {
    Array out;
    out.reserve(items.size());
    for (const toml::node& item : items)
      out.push_back((*this)(item));
    return out;
  }
  [[nodiscard]] Table table(const toml::table& entries) const {
    Table out;
    for (const auto& [key, item] : entries)
      out.emplace(std::string(key.str()), (*this)(item));
    return out;
  }

  std::shared_ptr<const std::string> origin_;
  Lines lines_;
};

/// TOML is parsed, converted and destroyed by functions that call themselves: what is nested too deep would exhaust their stack.
/// @throws core::Error naming the line
void check_depth(std::string_view text, const std::shared_ptr<const std::string>& origin, Lines lines) {
  int line = 1, depth = 0, parts = 0;
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      ++line;
      parts = 0;
      quote = '\0'; // brackets in texts of several lines count
    } else if (quote != '\0') {
      if (c == '\\' && quote == '"')
        ++i;
      else if (c == quote)
        quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      depth = std::max(0, depth - 1);
    } else if (c == '.') {
      ++parts;
    } else if (c == ',' || c == '=') {
      parts = 0;
    }
    if (depth > deepest || parts > deepest)
      throw core::Error(Where{origin, lines == Lines::kept ? line : 0}.text() +
                        ": tables or arrays nested more than " + std::to_string(deepest) +
                        " deep; no key of a study is");
  }
}

} // namespace

Value parse_toml(std::string_view text, std::shared_ptr<const std::string> origin, Lines lines) {
  check_depth(text, origin, lines);
  try {
    const toml::table parsed = toml::parse(text);
    Value root = Converter(origin, lines)(parsed);
    root.where.line = 0; // what the whole document lacks is on no line
    return root;
  } catch (const toml::parse_error& error) {
    const Where where{std::move(origin),
                      lines == Lines::kept ? static_cast<int>(error.source().begin.line) : 0};
    throw core::Error(where.text() + ": not valid TOML: " + std::string(error.description()));
  }
}

namespace {

Document parse_one(const std::filesystem::path& file) {
  Document document;
  document.file = std::filesystem::absolute(file).lexically_normal();
  document.text = core::read_input_file(file, "study file " + file.string(), most_bytes);
  document.root = parse_toml(document.text, std::make_shared<const std::string>(file.string()));
  return document;
}

/// `sweep.study`; nullptr: the file is a study itself.
const Value* study_of_sweep(const Document& document) {
  const auto& root = *document.root.table();
  const auto sweep = root.find("sweep");
  if (sweep == root.end() || !sweep->second.table())
    return nullptr;
  const auto study = sweep->second.table()->find("study");
  return study == sweep->second.table()->end() ? nullptr : &study->second;
}

} // namespace

Document parse(const std::filesystem::path& file) {
  Document own = parse_one(file);
  const Value* named = study_of_sweep(own);
  if (!named)
    return own;
  const std::string path = to_text(*named, "sweep.study");
  for (const auto& [key, value] : *own.root.table())
    if (key != "sweep")
      fail(value, key, "with sweep.study the file holds [sweep] only; give this in the study named there");
  Document study = parse_one(own.file.parent_path() / path);
  if (study_of_sweep(study))
    fail(*named, "sweep.study", "that file names another study itself; name the study");
  auto& root = std::get<Table>(study.root.data);
  root["sweep"] = own.root.table()->at("sweep");
  study.text += "\n# sweep\n" + own.text;
  return study;
}

void complete(Document& document, const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides)
    apply_override(document.root, text);
  apply_contact_defaults(document.root);
}

Document load(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Document document = parse(file);
  complete(document, overrides);
  return document;
}

} // namespace fretwork::study
