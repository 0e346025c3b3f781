// A straight tube of 9 m along x: 90 elements, supports each metre, mid-spans between.
For i In {0:18}
  Point(1 + i) = {0.5 * i, 0, 0};
EndFor
tube[] = {};
For i In {1:18}
  Line(i) = {i, i + 1};
  tube[] += {i};
EndFor
Transfinite Curve {1:18} = 6;
Physical Curve("tube") = {tube[]};
Physical Point("ends") = {1, 19};
Physical Point("supports") = {3, 5, 7, 9, 11, 13, 15, 17};
Physical Point("mid_spans") = {2, 4, 6, 8, 10, 12, 14, 16, 18};
Physical Point("odd_mid_spans") = {2, 6, 10, 14};
