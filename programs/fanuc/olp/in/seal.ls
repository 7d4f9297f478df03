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
/POS
P[1]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 120.500 mm,	Y = -60.250 mm,	Z = 260.000 mm,
        W = 180.000 deg,	P = 0.000 deg,	R = 0.000 deg
};
P[2]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 100.000 mm,	Y = -40.000 mm,	Z = 42.500 mm,
        W = -180.000 deg,	P = 0.500 deg,	R = 0.250 deg
};
P[3]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 180.125 mm,	Y = -38.500 mm,	Z = 40.000 mm,
        W = -179.500 deg,	P = 0.000 deg,	R = 0.000 deg
};
P[4]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 230.000 mm,	Y = 10.000 mm,	Z = 40.750 mm,
        W = 180.000 deg,	P = -0.125 deg,	R = 20.000 deg
};
P[5]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 180.000 mm,	Y = 60.000 mm,	Z = 40.000 mm,
        W = 180.000 deg,	P = 0.000 deg,	R = 45.000 deg
};
P[6]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 100.750 mm,	Y = 60.000 mm,	Z = 40.000 mm,
        W = 180.000 deg,	P = 0.750 deg,	R = 45.500 deg
};
P[7]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 100.000 mm,	Y = 80.000 mm,	Z = 200.000 mm,
        W = 175.000 deg,	P = -5.000 deg,	R = 60.000 deg
};
P[8]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 60.000 mm,	Y = 80.000 mm,	Z = 60.000 mm,
        W = 180.000 deg,	P = 0.000 deg,	R = 60.000 deg
};
P[9]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 20.000 mm,	Y = 40.000 mm,	Z = 62.500 mm,
        W = 180.000 deg,	P = 0.000 deg,	R = 30.000 deg
};
P[10]{
        GP1:
        UF : 4, UT : 1,        CONFIG: 'N U T, 0, 0, 0',
        X = 60.000 mm,	Y = 0.000 mm,	Z = 60.000 mm,
        W = 180.000 deg,	P = 0.000 deg,	R = 0.000 deg
};
P[11]{
        GP1:
        UF : 4, UT : 1,
        J1= 0.000 deg, J2= -20.000 deg, J3= -10.000 deg,
        J4= 0.000 deg, J5= -80.000 deg, J6= 0.000 deg
};
/END