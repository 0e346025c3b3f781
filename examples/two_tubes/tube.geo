// Two straight tubes of 2 m along x, side by side at a pitch of 20 mm: 20 elements each, one support plate in the middle.
For i In {0:1}
  Point(10 * i + 1) = {0.0, 0.02 * i, 0};
  Point(10 * i + 2) = {0.5, 0.02 * i, 0};
  Point(10 * i + 3) = {1.0, 0.02 * i, 0};
  Point(10 * i + 4) = {1.5, 0.02 * i, 0};
  Point(10 * i + 5) = {2.0, 0.02 * i, 0};
  For k In {1:4}
    Line(10 * i + k) = {10 * i + k, 10 * i + k + 1};
    Transfinite Curve {10 * i + k} = 6;
  EndFor
EndFor
Physical Curve("tubes") = {1, 2, 3, 4, 11, 12, 13, 14};
Physical Point("ends") = {1, 5, 11, 15};
Physical Point("plate") = {3, 13};
Physical Point("span_1") = {2};
Physical Point("span_2") = {12};
