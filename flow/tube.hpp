// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A tube as the fluid meets it: an ordered chain of beams of the model, from a starting node to its other end.
///
/// s is the curvilinear abscissa, true arc length in bends, 0 at the starting node; t(s) the unit tangent towards
/// larger s. The translation shapes phi_i(s) of a modal::Basis are those of the beam elements: exact for static loads
/// at the ends of the element, Hermite cubics on straight uniform beams (fem/flexible_beam.hpp).
/// Limits: round sections; no branches.
#pragma once
#include "fem/beam_element.hpp"
#include "modal/basis.hpp"
#include <span>
#include <string>
#include <vector>

namespace fretwork::flow {

using core::Index;
using core::Vec3;

/// The tube at one abscissa.
struct TubePoint {
  double s = 0.0;                                    ///< m
  Vec3 position = Vec3::Zero();                      ///< m
  Vec3 tangent = Vec3::Zero();                       ///< unit vector towards larger s
  double outer_diameter = 0.0, inner_diameter = 0.0; ///< m; inner: 0 of a solid bar
  double mass = 0.0; ///< kg/m, transverse inertia of the model: the tube and all its fluid and added mass
  double tube_mass = 0.0; ///< kg/m, of the tube alone: density times section
};

class Tube {
public:
  /// A beam of the tube, in the order of s.
  struct Element {
    Index beam;    ///< of the model
    bool reversed; ///< whether the beam's node b comes first
    double from;   ///< m, abscissa of its first node
    double to;     ///< m, of its second one
    Index first;   ///< node of the model at `from`
    Index second;  ///< at `to`
  };

  /// @param beams  numbers of beams of the model, in any order, each once
  /// @param start  node of the model at one end of the chain
  /// @param name   of the tube, for messages
  /// @throws core::Error where the beams do not form one chain, branch or repeat, where `start` is not an end of it,
  ///         or where a section is not round
  Tube(const fem::Model& model, std::span<const Index> beams, Index start, std::string name);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] double length() const { return elements_.back().to; } ///< m
  [[nodiscard]] const std::vector<Element>& elements() const { return elements_; }
  /// At an abscissa from 0 to length(). Between two elements: as the second has it.
  /// @throws core::Error for s outside the tube by more than round-off
  [[nodiscard]] TubePoint at(double s) const;
  /// Translation shapes at s, 3 x basis.size(), global axes, in the units of the basis.
  /// @throws core::Error for s outside, or where the basis is that of another structure
  [[nodiscard]] Eigen::Matrix3Xd shapes(const modal::Basis& basis, double s) const;
  /// Their mean over an interval of it, m, from < to: exact on straight uniform beams.
  [[nodiscard]] Eigen::Matrix3Xd mean_shapes(const modal::Basis& basis, double from, double to) const;

private:
  /// What an element is made of.
  struct Piece {
    fem::BeamElement element;
    fem::BeamProperty property;
    std::array<double, 2> along; ///< on the way of the property's taper
    Index a, b;                  ///< nodes, as the beam has them
  };
  /// Where an abscissa lies: the element and the share (0 to 1) of its beam from its node a.
  struct Place {
    std::size_t element;
    double share;
  };
  [[nodiscard]] Place locate(double s) const;
  void append(const fem::Model& model, Index beam, Index first);

  std::string name_;
  std::vector<Element> elements_;
  std::vector<Piece> pieces_;
};

} // namespace fretwork::flow
