// A span of 1 m along x in 100 elements; nodes for a stop at 0.21 and at 0.47 of it.
Point(1) = {0, 0, 0};
Point(2) = {0.21, 0, 0};
Point(3) = {0.47, 0, 0};
Point(4) = {1, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Transfinite Curve {1} = 22;
Transfinite Curve {2} = 27;
Transfinite Curve {3} = 54;
Physical Curve("span") = {1, 2, 3};
Physical Point("ends") = {1, 4};
Physical Point("at_21") = {2};
Physical Point("at_47") = {3};
