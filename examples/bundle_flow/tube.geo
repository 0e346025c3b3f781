// A row of five U-bends: legs of 2 m along z, bends of radius 0.5 m in planes x-z that stand side by side at a pitch of 25.4 mm along y.
tubes = 5;
pitch = 0.0254; // m
R = 0.5;        // bend radius, m
span = 1.0;     // between tube sheet and plate, plate and bend, m
h = 0.05;       // element size, m

feet[] = {}; plates[] = {}; tops[] = {};
For i In {1:tubes}
  p = 100 * i;
  y = (i - 1) * pitch;
  For k In {0:2}
    Point(p + k) = {-R, y, k * span, h};
    Point(p + 10 + k) = {R, y, k * span, h};
  EndFor
  Point(p + 20) = {0, y, 2 * span, h};     // centre of the bend
  Point(p + 21) = {0, y, 2 * span + R, h}; // its top
  For k In {1:2}
    Line(p + k) = {p + k - 1, p + k};
    Line(p + 10 + k) = {p + 10 + k - 1, p + 10 + k};
    Transfinite Curve {p + k, p + 10 + k} = Round(span / h) + 1;
  EndFor
  Circle(p + 21) = {p + 2, p + 20, p + 21};
  Circle(p + 22) = {p + 21, p + 20, p + 12};
  Transfinite Curve {p + 21, p + 22} = Round(R * Pi / 2 / h) + 1;
  feet[] += {p, p + 10};
  plates[] += {p + 1, p + 2, p + 11, p + 12};
  tops[] += {p + 21};
  Physical Curve(Sprintf("tube_%g", i)) = {p + 1, p + 2, p + 21, p + 22, p + 11, p + 12};
  Physical Curve(Sprintf("bend_%g", i)) = {p + 21, p + 22};
  Physical Point(Sprintf("foot_%g", i)) = {p};
  Physical Point(Sprintf("top_%g", i)) = {p + 21};
EndFor
Physical Point("feet") = {feet[]};
Physical Point("plates") = {plates[]};
Physical Point("tops") = {tops[]};
