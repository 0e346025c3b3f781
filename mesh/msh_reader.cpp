// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/msh_reader.hpp"
#include "core/error.hpp"
#include "mesh/msh_elements.hpp"
#include "mesh/msh_scanner.hpp"
#include <cstdlib>
#include <fstream>
#include <limits>
#include <unordered_map>

namespace fretwork::mesh {
namespace {

constexpr double legacy_version = 2.2;
constexpr double modern_version = 4.1;

std::string whole_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream)
    throw core::Error(file.string() + ": the mesh cannot be opened for reading");
  std::string text(static_cast<std::size_t>(stream.tellg()), '\0');
  stream.seekg(0);
  if (!stream.read(text.data(), static_cast<std::streamsize>(text.size())))
    throw core::Error(file.string() + ": the mesh cannot be read");
  return text;
}

/// The sign of a physical tag is an orientation.
int without_sign(const MshScanner& in, int tag) {
  if (tag == std::numeric_limits<int>::min())
    in.fail("a physical tag of " + std::to_string(tag) + " has no positive counterpart");
  return std::abs(tag);
}

class Reader {
public:
  Reader(std::string text, std::string file) : in_(std::move(text), std::move(file)) {}
  RawMesh read();

private:
  void read_format();
  void read_physical_names();
  void read_entities();
  void read_nodes_2();
  void read_nodes_4();
  void read_elements_2();
  void read_elements_4();
  std::vector<int> read_entity(int dimension);

  MshScanner in_;
  bool modern_ = false;
  MshNodes nodes_;
  MshElements elements_{in_, nodes_};
  std::unordered_map<int, std::vector<int>> physical_of_[2]; ///< by dimension and entity
};

void Reader::read_format() {
  if (in_.next_section() != "MeshFormat")
    in_.fail("not a gmsh mesh: it does not begin with $MeshFormat");
  const double version = in_.text_number();
  const bool binary = in_.text_integer() == 1;
  const int size_bytes = in_.text_integer();
  modern_ = version == modern_version;
  if (!modern_ && (version < 2.0 || version > legacy_version))
    in_.fail("format " + std::to_string(version).substr(0, 3) +
             " is not read; save the mesh as 4.1 or 2.2 (gmsh mesh.msh -save -format msh41 -o new.msh)");
  if (size_bytes != 8)
    in_.fail("numbers of " + std::to_string(size_bytes) + " bytes are not read, only of 8");
  in_.end_line();
  if (binary) {
    in_.set_binary();
    if (in_.integer() != 1)
      in_.fail("binary file of a machine with another byte order; save it as text");
  }
  in_.end_section();
}

void Reader::read_physical_names() {
  const int count = in_.text_integer();
  for (int i = 0; i < count; ++i) {
    const int dimension = in_.text_integer();
    const int tag = in_.text_integer();
    elements_.name_group(dimension, without_sign(in_, tag), in_.quoted());
  }
}

/// The physical tags of one entity; a point has 3 coordinates, all others a box and the entities that bound
/// them.
std::vector<int> Reader::read_entity(int dimension) {
  for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i)
    static_cast<void>(in_.number());
  std::vector<int> physical(in_.fitting(in_.size(), 1));
  for (int& tag : physical)
    tag = without_sign(in_, in_.integer());
  if (dimension > 0)
    for (std::size_t left = in_.fitting(in_.size(), 1); left > 0; --left)
      static_cast<void>(in_.integer());
  return physical;
}

void Reader::read_entities() {
  std::size_t counts[4];
  for (std::size_t& count : counts)
    count = in_.size();
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::size_t i = 0; i < counts[dimension]; ++i) {
      const int tag = in_.integer();
      auto physical = read_entity(dimension);
      if (dimension < 2)
        physical_of_[dimension][tag] = std::move(physical);
    }
}

void Reader::read_nodes_2() {
  const auto count = in_.fitting(static_cast<std::size_t>(in_.text_integer()), 8);
  in_.end_line();
  nodes_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const int tag = in_.integer();
    const double x = in_.number(), y = in_.number(), z = in_.number();
    nodes_.add(in_, static_cast<std::size_t>(tag), {x, y, z});
  }
}

void Reader::read_nodes_4() {
  const std::size_t blocks = in_.size();
  nodes_.reserve(in_.fitting(in_.size(), 8));
  static_cast<void>(in_.size());
  static_cast<void>(in_.size());
  std::vector<std::size_t> tags;
  for (std::size_t b = 0; b < blocks; ++b) {
    const int dimension = in_.integer();
    static_cast<void>(in_.integer());
    const int parameters = in_.integer() != 0 ? dimension : 0;
    tags.resize(in_.fitting(in_.size(), 8));
    for (std::size_t& tag : tags)
      tag = in_.size();
    for (const std::size_t tag : tags) {
      const double x = in_.number(), y = in_.number(), z = in_.number();
      for (int i = 0; i < parameters; ++i)
        static_cast<void>(in_.number());
      nodes_.add(in_, tag, {x, y, z});
    }
  }
}

void Reader::read_elements_2() {
  const auto count = in_.fitting(static_cast<std::size_t>(in_.text_integer()), 8);
  in_.end_line();
  std::vector<int> tags;
  for (std::size_t done = 0; done < count;) {
    // A text element carries its own header; a binary header serves a block of elements and gives no number.
    if (!in_.is_binary())
      static_cast<void>(in_.integer());
    const int type = in_.integer();
    const int in_block = in_.is_binary() ? in_.integer() : 1;
    tags.resize(in_.fitting(static_cast<std::size_t>(in_.integer()), 1));
    if (in_block < 1)
      in_.fail("a block of " + std::to_string(in_block) + " elements");
    for (int i = 0; i < in_block; ++i, ++done) {
      if (in_.is_binary())
        static_cast<void>(in_.integer());
      for (int& tag : tags)
        tag = in_.integer();
      const int physical = tags.empty() ? 0 : without_sign(in_, tags[0]);
      elements_.begin(type, 0, {&physical, physical == 0 ? 0u : 1u});
      for (int n = elements_.node_count(); n > 0; --n)
        elements_.add_node(static_cast<std::size_t>(in_.integer()));
      elements_.end();
    }
  }
}

void Reader::read_elements_4() {
  const std::size_t blocks = in_.size();
  for (int i = 0; i < 3; ++i)
    static_cast<void>(in_.size());
  for (std::size_t b = 0; b < blocks; ++b) {
    const int dimension = in_.integer();
    const int entity = in_.integer();
    const int type = in_.integer();
    const std::size_t count = in_.fitting(in_.size(), 4);
    std::span<const int> physical;
    if (dimension == 0 || dimension == 1)
      physical = physical_of_[dimension][entity];
    for (std::size_t i = 0; i < count; ++i) {
      static_cast<void>(in_.size());
      elements_.begin(type, entity, physical);
      for (int n = elements_.node_count(); n > 0; --n)
        elements_.add_node(in_.size());
      elements_.end();
    }
  }
}

RawMesh Reader::read() {
  read_format();
  for (;;) {
    const std::string_view section = in_.next_section();
    if (section.empty())
      break;
    if (section == "PhysicalNames")
      read_physical_names();
    else if (section == "Entities" && modern_)
      read_entities();
    else if (section == "PartitionedEntities")
      in_.fail("a partitioned mesh is not read; save it without its partition (gmsh: Mesh > Unpartition)");
    else if (section == "Nodes")
      modern_ ? read_nodes_4() : read_nodes_2();
    else if (section == "Elements")
      modern_ ? read_elements_4() : read_elements_2();
    else {
      in_.skip_section();
      continue;
    }
    in_.end_section();
  }
  return elements_.finish();
}

} // namespace

RawMesh read_msh(const std::filesystem::path& file) { return read_msh_text(whole_file(file), file.string()); }

RawMesh read_msh_text(std::string text, const std::string& name) {
  return Reader(std::move(text), name).read();
}

} // namespace fretwork::mesh
