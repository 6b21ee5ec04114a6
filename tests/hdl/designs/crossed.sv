// Set-up words without a clock, from cross products of whole coordinates; both windings by exchanging ends.
module crossed (
  input  [22:0] ax, ay, bx, by, cx, cy,
  input  [23:0] az, bz, cz,
  output [34:0] e0i, e0x, e0y, e1i, e1x, e1y, e2i, e2x, e2y,
  output        flat,
  output [46:0] area2,
  output signed [79:0] gx, gy, ps
);
  // raw cross products, unsigned 46 bit
  wire [45:0] axby = ax*by, aybx = ay*bx, bxcy = bx*cy, bycx = by*cx, cxay = cx*ay, cyax = cy*ax;
  // x_from*y_to - x_to*y_from
  wire signed [46:0] cab = $signed({1'b0,axby}) - $signed({1'b0,aybx});
  wire signed [46:0] cbc = $signed({1'b0,bxcy}) - $signed({1'b0,bycx});
  wire signed [46:0] cca = $signed({1'b0,cxay}) - $signed({1'b0,cyax});
  wire signed [48:0] area = cab + cbc + cca;   // exact: sum of the constants
  wire neg = area[48];
  assign flat = ~|area;
  assign area2 = neg ? -area[46:0] : area[46:0];
  wire live = |area;

  // E as constants of the unordered triangle; A = yf-yt, B = xt-xf
  wire signed [23:0] Aab = $signed({1'b0,ay})-$signed({1'b0,by}), Bab = $signed({1'b0,bx})-$signed({1'b0,ax});
  wire signed [23:0] Abc = $signed({1'b0,by})-$signed({1'b0,cy}), Bbc = $signed({1'b0,cx})-$signed({1'b0,bx});
  wire signed [23:0] Aca = $signed({1'b0,cy})-$signed({1'b0,ay}), Bca = $signed({1'b0,ax})-$signed({1'b0,cx});
  wire signed [23:0] ta = Aab+Bab, tb = Abc+Bbc, tc = Aca+Bca;   // may need 25 bits
  wire signed [24:0] Sab = Aab+Bab, Sbc = Abc+Bbc, Sca = Aca+Bca;
  wire signed [47:0] Eab = cab + (Sab <<< 9);
  wire signed [47:0] Ebc = cbc + (Sbc <<< 9);
  wire signed [47:0] Eca = cca + (Sca <<< 9);

  // swapped: order a c b : edges ac, cb, ba = -ca, -bc, -ab
  wire signed [47:0] E0 = neg ? -Eca : Eab;
  wire signed [47:0] E1 = neg ? -Ebc : Ebc;
  wire signed [47:0] E2 = neg ? -Eab : Eca;
  wire signed [23:0] A0 = neg ? -Aca : Aab, A1 = neg ? -Abc : Abc, A2 = neg ? -Aab : Aca;
  wire signed [23:0] B0 = neg ? -Bca : Bab, B1 = neg ? -Bbc : Bbc, B2 = neg ? -Bab : Bca;
  // owns: dy<0 -> A>0;  dy==0&&dx>0
  wire o0 = A0 > 0 || (A0 == 0 && B0 > 0);
  wire o1 = A1 > 0 || (A1 == 0 && B1 > 0);
  wire o2 = A2 > 0 || (A2 == 0 && B2 > 0);
  wire signed [47:0] F0 = o0 ? E0 : E0 - 48'sd1;
  wire signed [47:0] F1 = o1 ? E1 : E1 - 48'sd1;
  wire signed [47:0] F2 = o2 ? E2 : E2 - 48'sd1;
  assign e0i = live ? F0[44:10] : 35'd0;
  assign e1i = live ? F1[44:10] : 35'd0;
  assign e2i = live ? F2[44:10] : 35'd0;
  assign e0x = live ? {{11{A0[23]}},A0} : 35'd0;
  assign e1x = live ? {{11{A1[23]}},A1} : 35'd0;
  assign e2x = live ? {{11{A2[23]}},A2} : 35'd0;
  assign e0y = live ? {{11{B0[23]}},B0} : 35'd0;
  assign e1y = live ? {{11{B1[23]}},B1} : 35'd0;
  assign e2y = live ? {{11{B2[23]}},B2} : 35'd0;

  // plane: sum z_k * A_opposite ; z = sum z_k E_opposite(k)
  wire signed [24:0] za = {1'b0,az}, zb = {1'b0,bz}, zc = {1'b0,cz};
  wire signed [79:0] gxu = za*Abc + zb*Aca + zc*Aab;
  wire signed [79:0] gyu = za*Bbc + zb*Bca + zc*Bab;
  wire signed [79:0] psu = za*Ebc + zb*Eca + zc*Eab;
  assign gx = neg ? -gxu : gxu;
  assign gy = neg ? -gyu : gyu;
  assign ps = neg ? -psu : psu;
endmodule
