%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE Tending
  ! poseshift compensated this file (version 0.1.0)
  ! profile 67a76cab2617a802fa5ea9e4da91307f2960c7860b954e2f6f80b0fcc588cb6b
  ! source 566544ecdd9e0f1f85a26eb6f5031a3e8f38fa51be2b6aa0e3b011b5162fdaa7
  !***********************************************************
  ! Turning shop, cell 12: raw parts from the tray into the chuck
  !***********************************************************
  CONST robtarget pWait:=[[312.784,-24.306,332.194],[0.019121,0.052102,-0.998458,0.001453],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray10:=[[41.119,35.365,23.707],[0.014809,0.025744,-0.999558,0.001444],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray11:=[[40.919,35.433,83.710],[0.014808,0.025803,-0.999556,0.001459],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray20:=[[96.067,35.465,23.922],[0.014698,0.025768,-0.999559,0.001340],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray21:=[[95.851,35.528,83.909],[0.014702,0.025823,-0.999557,0.001353],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray30:=[[150.984,35.553,24.151],[0.014602,0.025798,-0.999560,0.001257],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pTray31:=[[150.751,35.610,84.121],[0.014614,0.025849,-0.999558,0.001270],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pChuck10:=[[60.072,19.682,33.283],[0.053678,-0.103947,0.993102,0.007829],[0,-1,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pChuck11:=[[59.949,19.457,98.265],[0.053700,-0.104010,0.993095,0.007800],[0,-1,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
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
