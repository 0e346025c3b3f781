// A fuel rod along z, in eight grids. Each has springs at its middle and dimples below and above them.
grids = 8;
spacing = 0.522;   // m, from grid to grid
first = 0.08;      // m, of the first grid above the lower end of the rod
dimple = 0.012;    // m, of dimples from the middle of their grid
length = 3.85;     // m
elements = 20;     // between two grids

Point(1) = {0, 0, 0};
below[] = {}; middle[] = {}; above[] = {};
For g In {0:grids - 1}
  z = first + g * spacing;
  p = 3 * g + 2;
  Point(p) = {0, 0, z - dimple};
  Point(p + 1) = {0, 0, z};
  Point(p + 2) = {0, 0, z + dimple};
  Line(p - 1) = {p - 1, p}; // the span below
  Line(p) = {p, p + 1};
  Line(p + 1) = {p + 1, p + 2};
  Transfinite Curve {p - 1} = elements + 1;
  Transfinite Curve {p, p + 1} = 2;
  below[] += {p}; middle[] += {p + 1}; above[] += {p + 2};
EndFor
last = 3 * grids + 2;
Point(last) = {0, 0, length};
Line(last - 1) = {last - 1, last};
Transfinite Curve {1, last - 1} = 4; // the ends

Physical Curve("rod") = {1:last - 1};
For g In {1:grids - 1}
  Physical Curve(Sprintf("span_%g", g)) = {3 * g + 1};
EndFor
Physical Point("foot") = {1};
Physical Point("lost") = {middle[0]};
Physical Point("springs") = {middle[{1:grids - 1}]};
Physical Point("below") = {below[]};
Physical Point("above") = {above[]};
