%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE Tending
  !***********************************************************
  ! Turning shop, cell 12: raw parts from the tray into the chuck
  !***********************************************************
  CONST robtarget pWait:=[[312.50,-24.75,331.20],[0.021785,0.052324,-0.998392,0.001142],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray10:=[[40.00,35.20,22.40],[0.017446,0.026173,-0.999505,0.000457],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray11:=[[40.00,35.20,82.40],[0.017446,0.026173,-0.999505,0.000457],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray20:=[[95.00,35.20,22.40],[0.017446,0.026173,-0.999505,0.000457],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray21:=[[95.00,35.20,82.40],[0.017446,0.026173,-0.999505,0.000457],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray30:=[[150.00,35.20,22.40],[0.017446,0.026173,-0.999505,0.000457],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray31:=[[150.00,35.20,82.40],[0.017446,0.026173,-0.999505,0.000457],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pChuck10:=[[60.10,18.70,31.90],[0.052049,-0.104385,0.993159,0.005471],[0,-1,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pChuck11:=[[60.10,18.70,96.90],[0.052049,-0.104385,0.993159,0.005471],[0,-1,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST jointtarget jHome:=[[0,-20,20,0,70,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST speeddata vFeed:=[80,60,5000,1000];

  PROC main()
    rRetreat;
    MoveAbsJ jHome\NoEOffs,v1000,fine,tGripper;
    WHILE DI_Start=1 DO
      rPick pTray10,pTray11,wTray;
      rPlace pChuck10, pChuck11, wChuck;
      rPick pTray20,pTray21,wTray;
      rPlace pChuck10, pChuck11, wChuck;
      rPick pTray30,pTray31,wTray;
      rPlace pChuck10, pChuck11, wChuck;
      nPartsDone:=nPartsDone+3;
    ENDWHILE
    MoveAbsJ jHome\NoEOffs,v1000,fine,tGripper;
  ENDPROC

  ! --- take a part: down to pAt, close, and up with it ---
  PROC rPick(robtarget pAt,robtarget pAbove,PERS wobjdata wWhere)
    MoveJ pAbove,v800,z20,tGripper\WObj:=wWhere;
    MoveL pAt,vFeed,fine,tGripper\WObj:=wWhere;
    Grip 1;
    MoveL pAbove,v400,z20,tGripper\WObj:=wWhere;
  ENDPROC

  PROC rPlace(robtarget pAt,robtarget pAbove,PERS wobjdata wWhere)
    MoveJ pWait,v800,z50,tGripper;
    IF DI_DoorOpen=0 WaitDI DI_DoorOpen,1;
    MoveJ pAbove,v800,z20,tGripper\WObj:=wWhere;
    MoveL pAt,vFeed,fine,tGripper\WObj:=wWhere;
    Grip 0;
    MoveL pAbove,v400,z20,tGripper\WObj:=wWhere;
    MoveJ pWait,v800,z50,tGripper;
  ENDPROC

  ! --- stop the blend, then straight up from wherever the arm stands ---
  PROC rRetreat()
    VAR robtarget pNow;
    pNow:=CRobT(\Tool:=tGripper\WObj:=wobj0);
    MoveL pNow,v50,fine,tGripper;
    IF pNow.trans.z<300 MoveL Offs(pNow,0,0,60),v50,fine,tGripper;
  ENDPROC

  PROC Grip(num nClose)
    SetDO DO_Close,nClose;
    WaitTime 0.3;
  ENDPROC
ENDMODULE
