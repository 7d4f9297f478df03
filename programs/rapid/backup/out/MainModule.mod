%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE MainModule
  ! poseshift compensated this file (version 0.1.0)
  ! profile 67a76cab2617a802fa5ea9e4da91307f2960c7860b954e2f6f80b0fcc588cb6b
  ! source 935be61b822bb5dac1a73ff95e580f580315893afd1c9c161c4df944144bceef
  ! Zelle 4, Entnahme und Fügen. Stand nach ModPos vom 12.03., Höhe geprüft
  CONST jointtarget jHome:=[[0,-15,30,0,60,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pVor:=[[11.061,-120.741,181.619],[0.002539,-0.078213,0.996933,-0.001017],[-1,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pGreif:=[[24.090,-125.366,20.131],[0.002601,-0.078057,0.996945,-0.000991],[-1,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  !CONST robtarget pGreif:=[[20.11,24.5,18.4],[0.008727,0,-0.999962,0],[-1,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  PERS robtarget pAblage{4}:=[[[32.601,-61.119,41.699],[0.002736,-0.034515,0.999400,-0.000445],[-1,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]],
    [[33.345,-16.051,41.681],[0.002760,-0.034514,0.999400,-0.000131],[-1,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]],
    [[72.537,-61.774,41.848],[0.002792,-0.034529,0.999400,-0.000405],[-1,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]],
    [[73.291,-16.718,41.831],[0.002812,-0.034528,0.999400,-0.000115],[-1,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]]];
  CONST num nHub:=45;
  PERS num nTeil:=3;
  VAR bool bOk;

  PROC main()
    ConfJ\On;
    ConfL\On;
    SingArea\Wrist;
    MoveAbsJ jHome\NoEOffs,v200,fine,tGreifer;
    WHILE DInput(diStart)=0 DO
      TPWrite "Warten auf Start ! (MoveL gesperrt)";
      WaitTime 0.5;
    ENDWHILE
    rGreifen;
    FOR i FROM 1 TO 4 DO
      rAblegen i;
    ENDFOR
    rFuegen;
    MoveAbsJ jHome\NoEOffs,v200,fine,tGreifer;
  ENDPROC

  PROC rGreifen()
    Set doGreiferAuf;
    MoveJ pVor,v500,z20,tGreifer\WObj:=wTisch;
    MoveL Offs(pGreif,0,0,nHub),v200,z5,tGreifer\WObj:=wTisch;
    MoveL pGreif,v50,fine,tGreifer\WObj:=wTisch;
    Reset doGreiferAuf;
    WaitDI diGegriffen,1\MaxTime:=2\TimeFlag:=bOk;
    MoveL RelTool(pGreif,0,0,-40\Rz:=5),v100,z5,tGreifer\WObj:=wTisch;
    MoveL OFFS(pGreif,-10,0,80),v200,z10,tGreifer\WObj:=wTisch;
  ENDPROC

  PROC rAblegen(num nPlatz)
    MoveJ Offs(pAblage{nPlatz},0,0,60),v500,z10,tGreifer\WObj:=wTisch;
    MoveL pAblage{nPlatz},v50,fine,tGreifer\WObj:=wTisch;
    Set doGreiferAuf;
    WaitTime 0.2;
    MoveL Offs(pAblage{nPlatz},0,0,60),v200,z10,tGreifer\WObj:=wTisch;
  ENDPROC
ENDMODULE
