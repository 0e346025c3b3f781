// A U-bend: two legs of 2 m along z, a bend of radius 1 m in the plane x-z.
// Named points: the feet in the tube sheet, two plates on each leg, three anti-vibration bars in the bend at 45, 90 and 135 degrees.
R = 1.0;       // bend radius, m
span = 1.0;    // between tube sheet and plate, plate and bend, m
h = 0.05;      // element size, m

For k In {0:2}
  Point(100 + k) = {-R, 0, k * span, h};
  Point(200 + k) = { R, 0, k * span, h};
EndFor
For k In {1:2}
  Line(100 + k) = {100 + k - 1, 100 + k};
  Line(200 + k) = {200 + k - 1, 200 + k};
EndFor
Point(300) = {0, 0, 2 * span, h};
For k In {1:3}
  a = Pi - k * Pi / 4;
  Point(300 + k) = {R * Cos(a), 0, 2 * span + R * Sin(a), h};
EndFor
Circle(301) = {102, 300, 301};
Circle(302) = {301, 300, 302};
Circle(303) = {302, 300, 303};
Circle(304) = {303, 300, 202};
Transfinite Curve {101, 102, 201, 202} = Round(span / h) + 1;
Transfinite Curve {301:304} = Round(R * Pi / 4 / h) + 1;

Physical Curve("tube") = {101, 102, 301:304, 201, 202};
Physical Curve("bend") = {301:304};
Physical Point("hot_foot") = {100};
Physical Point("feet") = {100, 200};
Physical Point("plates") = {101, 102, 201, 202};
Physical Point("bars") = {301:303};
Physical Point("sides") = {301, 303};
