#include "verify/problem.h"

namespace pelage {

Problem make_problem(const TriangleMesh& mesh, Discretisation (*discretise)(Topology), bool interpolate) {
  Problem p{discretise(make_topology(mesh.points.size(), mesh.triangles)), mesh.points, {}, {}};
  if (interpolate) p.control = interpolating_control(p.discretisation, mesh.points);
  const Assembler assembler(p.discretisation);
  p.mass = assembler.mass(p.control);
  p.stiffness = assembler.stiffness(p.control);
  return p;
}

}  // namespace pelage
