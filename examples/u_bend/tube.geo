// A U-bend steam generator tube: two legs of 9 m along z, a bend of radius 1 m in the plane x-z.
// Named points: the feet in the tube sheet, nine support plates on each leg, four anti-vibration bars in the bend.
R = 1.0;       // bend radius, m
pitch = 1.0;   // between support plates, m
plates = 9;    // on each leg
h = 0.025;     // element size, m

// legs: points 100 + i (hot, x = -R) and 200 + i (cold, x = +R), i = 0 at the foot
For i In {0:plates}
  Point(100 + i) = {-R, 0, i * pitch, h};
  Point(200 + i) = { R, 0, i * pitch, h};
EndFor
hot[] = {}; cold[] = {};
For i In {1:plates}
  Line(100 + i) = {100 + i - 1, 100 + i};
  Line(200 + i) = {200 + i - 1, 200 + i};
  Transfinite Curve {100 + i, 200 + i} = Round(pitch / h) + 1;
  hot[] += {100 + i};
  cold[] += {200 + i};
EndFor

// the bend: five arcs between the four bars, at 36, 72, 108 and 144 degrees from the hot leg
Point(300) = {0, 0, plates * pitch, h};
For k In {1:4}
  a = Pi - k * Pi / 5;
  Point(300 + k) = {R * Cos(a), 0, plates * pitch + R * Sin(a), h};
EndFor
Circle(301) = {100 + plates, 300, 301};
Circle(302) = {301, 300, 302};
Circle(303) = {302, 300, 303};
Circle(304) = {303, 300, 304};
Circle(305) = {304, 300, 200 + plates};
Transfinite Curve {301:305} = Round(R * Pi / 5 / h) + 1;

Physical Curve("hot_leg") = {hot[]};
Physical Curve("cold_leg") = {cold[]};
Physical Curve("bend") = {301:305};
Physical Point("feet") = {100, 200};
For i In {1:plates}
  Physical Point(Sprintf("hot_tsp%g", i)) = {100 + i};
  Physical Point(Sprintf("cold_tsp%g", i)) = {200 + i};
EndFor
For k In {1:4}
  Physical Point(Sprintf("avb%g", k)) = {300 + k};
EndFor
