// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The linear algebra of a step, on contiguous arrays padded to `lanes` and aligned to 64 bytes. Each kernel
/// is compiled for several widths of vector unit and the processor picks one when the program starts; sums
/// always run over `lanes` partial sums, so that AVX2 and AVX-512 give the same bytes.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace fretwork::kernels {

/// One mode over one step, loads given at its two ends: q1 = qq q + qv v + qf0 f0 + qf1 f1, v1 likewise; mean
/// = the mean of q over the step.
struct StepCoefficients {
  double qq, qv, qf0, qf1;
  double vq, vv, vf0, vf1;
  double mq, mv, mf0, mf1;
};

inline constexpr int lanes = 8;
inline constexpr std::size_t alignment = 64;

/// Next multiple of `lanes`.
[[nodiscard]] constexpr int padded(int n) { return (n + lanes - 1) / lanes * lanes; }

template <class T> struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U> AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t(alignment)));
  }
  void deallocate(T* p, std::size_t) { ::operator delete(p, std::align_val_t(alignment)); }
  template <class U> bool operator==(const AlignedAllocator<U>&) const { return true; }
};
using Array = std::vector<double, AlignedAllocator<double>>;

/// Values of the modes, then zeros up to a multiple of `lanes`.
template <class Vector> [[nodiscard]] Array padded_copy(const Vector& values) {
  Array out(static_cast<std::size_t>(padded(static_cast<int>(values.size()))), 0.0);
  std::copy(values.data(), values.data() + values.size(), out.begin());
  return out;
}

/// The exact flow of all modes over one step: stiffness and StepCoefficients of `lanes` modes after those of others.
class FlowTable {
public:
  static constexpr int numbers = 13; ///< of a mode
  /// @param np  modes, all of them without stiffness and brought to rest at 0 until they are set
  explicit FlowTable(int np) : values_(static_cast<std::size_t>(numbers * np), 0.0) {}
  /// No allocation.
  void set(std::ptrdiff_t mode, double stiffness, const StepCoefficients& coefficients);
  [[nodiscard]] const double* data() const { return values_.data(); }

private:
  Array values_;
};

/// Vectors of 2, 4 and 8 doubles.
enum class VectorSize { pair, half, pack };
/// Lets the kernels use no wider vectors than these, nor than the processor has: what tests compare. Not while kernels run. Returns what
/// they use from now on.
VectorSize limit_vectors(VectorSize most);

/// The copies of a kernel by size of vectors: the widest that the processor has is chosen when the program starts, before `main` (not to be
/// called by what is made before it).
class KernelCopies {
protected:
  using Any = void (*)();
  KernelCopies(Any pair, Any half, Any pack);
  mutable Any chosen_;

private:
  friend VectorSize limit_vectors(VectorSize most);
  Any all_[3];
  const KernelCopies* next_; ///< of all kernels
};
template <class Function> class Kernel;
template <class Result, class... Arguments> class Kernel<Result(Arguments...)> : KernelCopies {
public:
  using Copy = Result (*)(Arguments...);
  Kernel(Copy pair, Copy half, Copy pack)
      : KernelCopies(reinterpret_cast<Any>(pair), reinterpret_cast<Any>(half), reinterpret_cast<Any>(pack)) {}
  Result operator()(Arguments... arguments) const { return reinterpret_cast<Copy>(chosen_)(arguments...); }
};

/// Which instruction set the kernels use here: "AVX-512 (8 doubles)", "AVX2 (4 doubles)" or "SSE2 (2
/// doubles)".
[[nodiscard]] const char* vector_width();

struct FlowSums {
  double work = 0.0;         ///< J, of the load over the step
  double twice_energy = 0.0; ///< J, as below, of the modes at its end
};
/// q, v <- exact flow under a load linear from f0 to f1.
extern const Kernel<FlowSums(int np, const FlowTable& table, double* q, double* v, const double* f0,
                             const double* f1)>
    flow_loaded;
/// The same without load.
extern const Kernel<FlowSums(int np, const FlowTable& table, double* q, double* v)> flow_free;

struct ForcedSums {
  double load_work = 0.0, contact_work = 0.0; ///< J, of both forces over the step
  double twice_energy = 0.0;                  ///< J
};
/// q, v <- exact flow under a load linear from f0 to f1 and a contact force linear from mean - slope to mean + slope.
extern const Kernel<ForcedSums(int np, const FlowTable& table, double* q, double* v, const double* f0,
                               const double* f1, const double* mean, const double* slope)>
    flow_forced;

/// Displacements of all modes in the middle of a step: four coefficients of q0, v0, f0, f1 for each mode.
class MiddleTable {
public:
  static constexpr int numbers = 4;
  explicit MiddleTable(int np) : values_(static_cast<std::size_t>(numbers * np), 0.0) {}
  void set(std::ptrdiff_t mode, const double (&coefficients)[numbers]) {
    const std::ptrdiff_t lane = mode % lanes, first = numbers * (mode - lane) + lane;
    for (std::ptrdiff_t k = 0; k < numbers; ++k)
      values_[static_cast<std::size_t>(first + k * lanes)] = coefficients[k];
  }
  [[nodiscard]] const double* data() const { return values_.data(); }

private:
  Array values_;
};
/// Under a load linear from f0 - slope to f1 + slope, `mean` added throughout.
extern const Kernel<void(int np, const MiddleTable& table, const double* q0, const double* v0,
                         const double* f0, const double* f1, const double* mean, const double* slope,
                         double* q)>
    middle;

/// f = sum over s of value[s] * shape[s], shapes one after the other, np apart.
extern const Kernel<void(int np, int sources, const double* shapes, const double* values, double* f)> combine;

/// sum of v^2 + k q^2 over modes: twice the energy.
extern const Kernel<double(int np, const double* k, const double* q, const double* v)> twice_energy;

/// How many contacts there are, and lanes: their number, padded.
struct LaneCount {
  int count = 0, width = 0;
  /// So few that one after the other is faster than in packs, or half packs do.
  [[nodiscard]] bool few() const { return count <= 2; }
  [[nodiscard]] bool half() const { return count <= lanes / 2; }
  /// Contacts taken at once.
  [[nodiscard]] int together() const { return few() ? 1 : half() ? lanes / 2 : lanes; }
};

/// One number of `lanes` contacts.
using Numbers = double[lanes];
/// Where a contact stands among these.
[[nodiscard]] constexpr int lane(int contact) {
  return static_cast<int>(static_cast<unsigned>(contact) % lanes);
}

/// Numbers of contacts: those of `lanes` contacts lie together, at distances that compilers know.
template <class Pack> class LaneTable {
public:
  LaneTable() = default;
  /// All 0.   @param width  contacts, padded
  explicit LaneTable(int width) : packs_(static_cast<std::size_t>(width / lanes)) {}
  /// The pack in which a contact stands.
  [[nodiscard]] Pack& operator[](int contact) { return packs_[static_cast<unsigned>(contact) / lanes]; }
  [[nodiscard]] const Pack& operator[](int contact) const {
    return packs_[static_cast<unsigned>(contact) / lanes];
  }
  template <class Archive> void visit(Archive& state) { state(packs_); }

private:
  std::vector<Pack, AlignedAllocator<Pack>> packs_;
};

/// Numbers with room for all from the start: a vector that could grow takes registers in the kernels that add to it.
class PlaceList {
public:
  explicit PlaceList(int room) : room_(static_cast<std::size_t>(room)) {}
  [[nodiscard]] const int* begin() const { return room_.data(); }
  [[nodiscard]] const int* end() const { return room_.data() + count_; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] int size() const { return count_; }
  [[nodiscard]] int front() const { return room_[0]; }
  [[nodiscard]] int back() const { return end()[-1]; }
  void clear() { count_ = 0; }
  void push_back(int place) { room_[static_cast<std::size_t>(count_++)] = place; }
  void swap(PlaceList& other) {
    room_.swap(other.room_);
    std::swap(count_, other.count_);
  }
  template <class Archive> void visit(Archive& state) {
    std::vector<int> listed;
    listed.reserve(room_.size());
    listed.assign(begin(), end());
    state(listed);
    clear();
    for (const int place : listed)
      push_back(place);
  }

private:
  std::vector<int> room_;
  int count_ = 0;
};

/// The places at which a step has something to do: first lanes of `together` contacts each, by increasing number.
struct Places {
  explicit Places(const LaneCount& contacts) : all(contacts), first(contacts.width) {}
  /// That of a contact. Those of increasing contacts, one after the other.
  void add_contact(int c) {
    const int lane = c - c % all.together();
    if (first.empty() || first.back() != lane)
      first.push_back(lane);
  }
  LaneCount all;
  PlaceList first;
  double near = 0.0; ///< contacts that are found near
};

/// A matrix of `lanes`-wide packs of rows, each with the columns (modes) that are not zero in it: contacts whose local axes lie along
/// the planes of the modes meet half of them.
struct GatherTable {
  std::vector<int> begin{0}; ///< pack p has the entries begin[p] to begin[p + 1]
  std::vector<int> modes;
  Array values;      ///< `lanes` an entry
  bool half = false; ///< all rows stand in the first half of their packs
  /// Appends a pack of rows: their values in the modes in which one of them has any.
  void add_pack(const std::map<int, std::array<double, lanes>>& values_of_modes);

  /// A part of a row by itself, over modes that follow each other: to[lane] += values . from[first ...]. One or two rows, and rows whose
  /// modes have little in common, cost less so than in a pack.
  struct Part {
    int lane, first, size; ///< both multiples of `lanes`
    std::size_t values;    ///< its first in `of_parts`
  };
  std::vector<Part> parts; ///< added to the packs, in this order
  Array of_parts;
};
/// u = G q and w = G v. Vectors of the modes padded by finite numbers and aligned, as all that kernels take.
extern const Kernel<void(const GatherTable& g, const double* q, const double* v, double* u, double* w)>
    gather_two;
/// u = G q.
extern const Kernel<void(const GatherTable& g, const double* q, double* u)> gather;

/// u = G q of `gathered_together` vectors: the table, which may be larger than the caches, is read once. q and u follow each other, `q_stride` and
/// `u_stride` doubles apart, both multiples of `lanes`.
inline constexpr int gathered_together = 8;
extern const Kernel<void(const GatherTable& g, const double* q, int q_stride, double* u, int u_stride)>
    gather_together;

/// v += sum over r of factor[r] * row[r].
extern const Kernel<void(int np, int rows, const double* const* row, const double* factor, double* v)>
    scatter;
/// The same for two to five vectors v, each with factors of its own: rows are read once.
inline constexpr int most_scattered = 5;
struct ScatterTarget {
  const double* factor;
  double* v;
};
extern const Kernel<void(int np, int rows, const double* const* row, int targets,
                         const ScatterTarget* target)>
    scatter_several;
/// One step of the semi-implicit Euler scheme: v1 = v + h (f - c v - k q), q1 = q + h v1, f including the
/// contact forces. Returns the sums over modes with vm = (v + v1)/2.
struct EulerSums {
  double twice_energy;  ///< vm^2 + k q^2, at the start of the step
  double load_power;    ///< load . vm
  double damping_power; ///< c vm^2
};
extern const Kernel<EulerSums(int np, double h, const double* c, const double* k, const double* load,
                              const double* force, double* q, double* v)>
    euler_step;

} // namespace fretwork::kernels
