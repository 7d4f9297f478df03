/PROG  OLP_SEAL
/ATTR
OWNER = MNEDITOR;
COMMENT = "sealing – joint, part 7";
LINE_COUNT = 13;
PROTECT = READ_WRITE;
DEFAULT_GROUP = 1,*,*,*,*;
/MN
   1:  ! exported cell 4 ;
   2:  UFRAME_NUM=4 ;
   3:  UTOOL_NUM=1 ;
   4:J P[1] 50% CNT10 ;
   5:L P[2] 200mm/sec FINE ;
   6:L P[3] 80mm/sec CNT5 ;
   7:C P[4] 
       P[5] 80mm/sec CNT5 ;
   8:L P[6] 80mm/sec FINE ;
   9:L P[7] 400mm/sec CNT50 ;
  10:A P[8] 80mm/sec CNT100 ;
  11:A P[9] 80mm/sec CNT100 ;
  12:A P[10] 80mm/sec FINE ;
  13:J P[11] 50% FINE ;
  14:  !poseshift compensated this file ;
  15:  !profile 951c731243aceecbfdf0a9da ;
  16:  !source afdf683fc370ddec v0.1.0 ;
/POS
P[1]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 121.940 mm,	Y = -60.504 mm,	Z = 263.028 mm,
        W = -179.976 deg,	P = -0.114 deg,	R = 0.099 deg
};
P[2]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 101.917 mm,	Y = -40.044 mm,	Z = 45.375 mm,
        W = -179.968 deg,	P = 0.389 deg,	R = 0.353 deg
};
P[3]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 182.022 mm,	Y = -38.596 mm,	Z = 43.103 mm,
        W = -179.468 deg,	P = -0.119 deg,	R = 0.102 deg
};
P[4]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 231.856 mm,	Y =  9.925 mm,	Z = 44.167 mm,
        W = 179.990 deg,	P = -0.242 deg,	R = 20.095 deg
};
P[5]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 181.892 mm,	Y = 60.056 mm,	Z = 43.414 mm,
        W = 179.946 deg,	P = -0.088 deg,	R = 45.087 deg
};
P[6]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 102.663 mm,	Y = 60.128 mm,	Z = 43.184 mm,
        W = 179.950 deg,	P = 0.668 deg,	R = 45.587 deg
};
P[7]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 101.694 mm,	Y = 80.076 mm,	Z = 203.317 mm,
        W = 174.919 deg,	P = -5.053 deg,	R = 60.085 deg
};
P[8]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 61.913 mm,	Y = 80.206 mm,	Z = 63.144 mm,
        W = 179.931 deg,	P = -0.057 deg,	R = 60.083 deg
};
P[9]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 21.888 mm,	Y = 40.132 mm,	Z = 65.391 mm,
        W = 179.979 deg,	P = -0.094 deg,	R = 30.094 deg
};
P[10]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 61.899 mm,	Y = 0.023 mm,	Z = 62.822 mm,
        W = -179.966 deg,	P = -0.109 deg,	R = 0.103 deg
};
P[11]{
        GP1:
        UF : 4, UT : 1,
        J1= 0.000 deg, J2= -20.000 deg, J3= -10.000 deg,
        J4= 0.000 deg, J5= -80.000 deg, J6= 0.000 deg
};
/END