// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/fields.hpp"
#include "fem/beam_element.hpp"
#include "fem/lumped.hpp"
#include <Eigen/Geometry>
#include <cassert>
#include <numeric>

namespace fretwork::fem {
namespace {

/// The parts a field acts on, and where the six rows of a node are.
struct Whole {
  explicit Whole(const Model& m)
      : beams(all(m.beams.size())), masses(all(m.masses.size())), springs(all(m.springs.size())),
        rows(static_cast<Eigen::Index>(m.nodes.size()) * dofs_per_node) {}
  static std::vector<Index> all(std::size_t count) {
    std::vector<Index> numbers(count);
    std::iota(numbers.begin(), numbers.end(), Index{0});
    return numbers;
  }
  static Eigen::Index row(Index node) { return Eigen::Index{node} * dofs_per_node; }
  std::vector<Index> beams, masses, springs;
  Eigen::Index rows;
};

struct Part {
  explicit Part(const Structure& s)
      : structure(s), beams(s.beams), masses(s.masses), springs(s.springs),
        rows(static_cast<Eigen::Index>(s.nodes.size()) * dofs_per_node) {}
  [[nodiscard]] Eigen::Index row(Index node) const {
    return Eigen::Index{position_of(structure, node)} * dofs_per_node;
  }
  const Structure& structure;
  const std::vector<Index>&beams, &masses, &springs;
  Eigen::Index rows;
};

/// Dofs of a beam, of one field.
template <class Column> Vector12 gather(const Column& field, Eigen::Index a, Eigen::Index b) {
  Vector12 u;
  u << field.template segment<6>(a), field.template segment<6>(b);
  return u;
}

template <class Domain>
Eigen::MatrixXd apply_mass(const Model& model, const Domain& domain, const Eigen::MatrixXd& fields) {
  assert(fields.rows() == domain.rows);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(fields.rows(), fields.cols());
  for (const Index number : domain.beams) {
    const Beam& beam = model.beams[static_cast<std::size_t>(number)];
    const Matrix12 m = BeamElement(model, beam).mass();
    const Eigen::Index a = domain.row(beam.a), b = domain.row(beam.b);
    for (Eigen::Index j = 0; j < fields.cols(); ++j) {
      const Vector12 f = m * gather(fields.col(j), a, b);
      result.col(j).segment<6>(a) += f.head<6>();
      result.col(j).segment<6>(b) += f.tail<6>();
    }
  }
  for (const Index number : domain.masses) {
    const LumpedMass& body = model.masses[static_cast<std::size_t>(number)];
    const Eigen::Index row = domain.row(body.node);
    result.middleRows<6>(row) += lumped_mass_matrix(body) * fields.middleRows<6>(row);
  }
  return result;
}

template <class Domain>
Eigen::MatrixXd apply_stiffness(const Model& model, const Domain& domain, const Eigen::MatrixXd& fields) {
  assert(fields.rows() == domain.rows);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(fields.rows(), fields.cols());
  for (const Index number : domain.beams) {
    const Beam& beam = model.beams[static_cast<std::size_t>(number)];
    const BeamElement element(model, beam);
    const Eigen::Index a = domain.row(beam.a), b = domain.row(beam.b);
    for (Eigen::Index j = 0; j < fields.cols(); ++j) {
      const Vector12 f = element.elastic_force(gather(fields.col(j), a, b));
      result.col(j).segment<6>(a) += f.head<6>();
      result.col(j).segment<6>(b) += f.tail<6>();
    }
  }
  for (const Index number : domain.springs) {
    const Spring& spring = model.springs[static_cast<std::size_t>(number)];
    const Eigen::Index a = domain.row(spring.node);
    for (int d = 0; d < dofs_per_node; ++d) {
      const double k = spring.stiffness[static_cast<std::size_t>(d)];
      if (spring.other < 0) {
        result.row(a + d) += k * fields.row(a + d);
        continue;
      }
      const Eigen::Index b = domain.row(spring.other);
      const Eigen::RowVectorXd force = k * (fields.row(a + d) - fields.row(b + d));
      result.row(a + d) += force;
      result.row(b + d) -= force;
    }
  }
  return result;
}

} // namespace

Eigen::VectorXd mass_times(const Model& model, const Eigen::VectorXd& field) {
  return apply_mass(model, Whole(model), field);
}

Eigen::VectorXd stiffness_times(const Model& model, const Eigen::VectorXd& field) {
  return apply_stiffness(model, Whole(model), field);
}

Eigen::MatrixXd mass_times(const Model& model, const Structure& structure, const Eigen::MatrixXd& fields) {
  return apply_mass(model, Part(structure), fields);
}

Eigen::MatrixXd stiffness_times(const Model& model, const Structure& structure,
                                const Eigen::MatrixXd& fields) {
  return apply_stiffness(model, Part(structure), fields);
}

Eigen::MatrixXd forces_on_equations(const Structure& structure, const Eigen::MatrixXd& forces) {
  assert(forces.rows() == static_cast<Eigen::Index>(structure.equation.size()));
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(structure.equations, forces.cols());
  for (Eigen::Index j = 0; j < forces.cols(); ++j)
    for (std::size_t i = 0; i < structure.equation.size(); ++i)
      if (structure.equation[i] >= 0)
        sums(structure.equation[i], j) += forces(static_cast<Eigen::Index>(i), j);
  return sums;
}

Eigen::VectorXd twice_strain_energy(const Model& model, const Structure& structure,
                                    const Eigen::MatrixXd& fields) {
  const Part part(structure);
  assert(fields.rows() == part.rows);
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(fields.cols());
  for (const Index number : part.beams) {
    const Beam& beam = model.beams[static_cast<std::size_t>(number)];
    const BeamElement element(model, beam);
    const Eigen::Index a = part.row(beam.a), b = part.row(beam.b);
    for (Eigen::Index j = 0; j < fields.cols(); ++j)
      energy[j] += element.twice_strain_energy(gather(fields.col(j), a, b));
  }
  for (const Index number : part.springs) {
    const Spring& spring = model.springs[static_cast<std::size_t>(number)];
    const Eigen::Index a = part.row(spring.node);
    const Eigen::Index b = spring.other < 0 ? -1 : part.row(spring.other);
    for (int d = 0; d < dofs_per_node; ++d)
      for (Eigen::Index j = 0; j < fields.cols(); ++j) {
        const double stretch = fields(a + d, j) - (b < 0 ? 0.0 : fields(b + d, j));
        energy[j] += spring.stiffness[static_cast<std::size_t>(d)] * stretch * stretch;
      }
  }
  return energy;
}

Eigen::VectorXd stiffness_diagonal(const Model& model, const Structure& structure) {
  const Part part(structure);
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(part.rows);
  for (const Index number : part.beams) {
    const Beam& beam = model.beams[static_cast<std::size_t>(number)];
    const Vector12 k = BeamElement(model, beam).stiffness().diagonal();
    diagonal.segment<6>(part.row(beam.a)) += k.head<6>();
    diagonal.segment<6>(part.row(beam.b)) += k.tail<6>();
  }
  for (const Index number : part.springs) {
    const Spring& spring = model.springs[static_cast<std::size_t>(number)];
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> k(spring.stiffness.data());
    diagonal.segment<6>(part.row(spring.node)) += k;
    if (spring.other >= 0)
      diagonal.segment<6>(part.row(spring.other)) += k;
  }
  return diagonal;
}

Eigen::VectorXd translation_field(const Model& model, const Vec3& direction) {
  Eigen::VectorXd field = Eigen::VectorXd::Zero(Whole(model).rows);
  for (Index node = 0; node < static_cast<Index>(model.nodes.size()); ++node)
    field.segment<3>(Whole::row(node)) = direction;
  return field;
}

Eigen::VectorXd point_forces(const Model& model, std::span<const Index> nodes, const Vec3& value,
                             bool moment) {
  Eigen::VectorXd field = Eigen::VectorXd::Zero(Whole(model).rows);
  for (const Index node : nodes)
    field.segment<3>(Whole::row(node) + (moment ? 3 : 0)) += value;
  return field;
}

Eigen::VectorXd line_forces(const Model& model, std::span<const Index> beams, const Vec3& force_per_length) {
  Eigen::VectorXd field = Eigen::VectorXd::Zero(Whole(model).rows);
  for (const Index number : beams) {
    const Beam& beam = model.beams[static_cast<std::size_t>(number)];
    const Vector12 force = BeamElement(model, beam).line_force(force_per_length);
    field.segment<6>(Whole::row(beam.a)) += force.head<6>();
    field.segment<6>(Whole::row(beam.b)) += force.tail<6>();
  }
  return field;
}

} // namespace fretwork::fem
