// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/document.hpp"
#include "core/error.hpp"
#include <fstream>
#include <sstream>
#include <toml++/toml.h>

namespace fretwork::study {
namespace {

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

std::string read_text(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw core::Error("study file " + file.string() + " does not exist; give the path of a .toml file");
  if (std::filesystem::is_directory(file, ignored))
    throw core::Error("study file " + file.string() + " is a directory; give the path of a .toml file");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream)
    throw core::Error("study file " + file.string() + " cannot be read; check its permissions");
  return text.str();
}

} // namespace

Value parse_toml(std::string_view text, std::shared_ptr<const std::string> origin, Lines lines) {
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

Document load(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Document document;
  document.file = std::filesystem::absolute(file).lexically_normal();
  document.text = read_text(file);
  document.root = parse_toml(document.text, std::make_shared<const std::string>(file.string()));
  for (const std::string& text : overrides)
    apply_override(document.root, text);
  apply_contact_defaults(document.root);
  return document;
}

} // namespace fretwork::study
