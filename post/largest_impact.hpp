// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The history of force about the largest impact of every contact, independent of any sampling.
///
/// A history has points with a normal force about the largest one of the window, `points` / 2 up to it and as many after it at most, and points
/// without force where the contact closes and opens. Of schemes that know forces within steps (ForcePiece) they are those at four places of each
/// piece, where it is largest and its end among them; two of one time are a jump. Of others they are means over steps, and the points without force
/// stand at the start of the step in which the contact closes and at the end of that in which it opens.
#pragma once
#include "transient/run.hpp"
#include <vector>

namespace fretwork::post {

struct ForcePoint {
  double time = 0.0;       ///< s
  double normal = 0.0;     ///< N, >= 0
  double tangential = 0.0; ///< N, length of the vector
};

class LargestImpact final : public transient::ContactObserver {
public:
  static constexpr std::size_t points = 512;

  /// @param contacts  number of contacts   @param from  start of the window, s
  LargestImpact(std::size_t contacts, double from);
  void step(const transient::Record& record) override;
  void visit(core::StateArchive& state) override { state(contacts_); }
  /// Of every contact, in time; empty where there was no force.
  [[nodiscard]] std::vector<std::vector<ForcePoint>> histories() const;

private:
  struct Contact {
    std::vector<ForcePoint> ring; ///< `points` of them, the last ones
    std::vector<ForcePoint> kept; ///< about the largest force, in time
    std::uint64_t count = 0;      ///< of points so far
    std::uint64_t still = 0;      ///< points to come until the ring is kept; 0: it has been
    double largest = 0.0;         ///< N
    bool closed = false;          ///< at the end of the record before
    double ended = 0.0;           ///< s: the last force
    void add(const ForcePoint& point);
    /// @param touched  the contact has closed in the step; else it was closed before the window too
    void add(const transient::ForcePiece& piece, double start, double step, bool touched);
    void look_at(double peak);
    void keep();
    void visit(core::StateArchive& state) { state(ring, kept, count, still, largest, closed, ended); }
  };
  double from_;
  std::vector<Contact> contacts_;
};

} // namespace fretwork::post
