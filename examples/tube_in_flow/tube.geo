// A straight tube of three spans of 0.5 m along x: tube sheets at both ends, two support plates.
h = 0.02;      // element size, m
Point(1) = {0.0, 0, 0, h};
Point(2) = {0.5, 0, 0, h};
Point(3) = {1.0, 0, 0, h};
Point(4) = {1.5, 0, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Transfinite Curve {1:3} = Round(0.5 / h) + 1;
Physical Curve("tube") = {1:3};
Physical Point("sheet_1") = {1};
Physical Point("plate_1") = {2};
Physical Point("plate_2") = {3};
Physical Point("sheet_2") = {4};
