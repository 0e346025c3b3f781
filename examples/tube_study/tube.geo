// A steam generator tube of the bundle's periphery: two legs of 8.4 m along z, a bend of radius 1 m in the plane x-z.
// Named points: the feet in the tube sheet, eight broached plates on each leg, four anti-vibration bars in the bend.
R = 1.0;        // bend radius, m
pitch = 1.05;   // between plates, m
plates = 8;     // on each leg
h = 0.035;      // element size, m

// legs: points 100 + i (hot, x = -R) and 200 + i (cold, x = +R), i = 0 at the foot
For i In {0:plates}
  Point(100 + i) = {-R, 0, i * pitch, h};
  Point(200 + i) = { R, 0, i * pitch, h};
EndFor
hot[] = {}; cold[] = {}; hot_points[] = {}; cold_points[] = {};
For i In {1:plates}
  Line(100 + i) = {100 + i - 1, 100 + i};
  Line(200 + i) = {200 + i - 1, 200 + i};
  Transfinite Curve {100 + i, 200 + i} = Round(pitch / h) + 1;
  hot[] += {100 + i};
  cold[] += {200 + i};
  hot_points[] += {100 + i};
  cold_points[] += {200 + i};
EndFor

// the bend: arcs between the hot leg, four bars at 36, 72, 108 and 144 degrees from it, the apex and the cold leg
Point(300) = {0, 0, plates * pitch, h};
For k In {1:4}
  a = Pi - k * Pi / 5;
  Point(300 + k) = {R * Cos(a), 0, plates * pitch + R * Sin(a), h};
EndFor
Circle(301) = {100 + plates, 300, 301};
Circle(302) = {301, 300, 302};
Point(305) = {0, 0, plates * pitch + R, h};
Circle(303) = {302, 300, 305};
Circle(306) = {305, 300, 303};
Circle(304) = {303, 300, 304};
Circle(305) = {304, 300, 200 + plates};
Transfinite Curve {301, 302, 304, 305} = Round(R * Pi / 5 / h) + 1;
Transfinite Curve {303, 306} = Round(R * Pi / 10 / h) + 1;

Physical Curve("tube") = {hot[], 301:306, cold[]};
Physical Point("hot_foot") = {100};
Physical Point("cold_foot") = {200};
Physical Point("feet") = {100, 200};
Physical Point("hot_plates") = {hot_points[]};
Physical Point("cold_plates") = {cold_points[]};
Physical Point("outer_bars") = {301, 304};
Physical Point("inner_bars") = {302, 303};
Physical Point("apex") = {305};
