%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE MainModule
  ! Zelle 4, Entnahme und Fügen. Stand nach ModPos vom 12.03., Höhe geprüft
  CONST jointtarget jHome:=[[0,-15,30,0,60,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pVor:=[[10.78,-121.19,180.41],[0,-0.078459,0.996917,0],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pGreif:=[[23.21,-125.65,18.81],[0,-0.078459,0.996917,0],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  !CONST robtarget pGreif:=[[20.11,24.5,18.4],[0.008727,0,-0.999962,0],[-1,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  PERS robtarget pAblage{4}:=[[[31.83,-61.54,40.41],[0,-0.034899,0.999391,0],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]],
    [[32.61,-16.55,40.41],[0,-0.034899,0.999391,0],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]],
    [[71.82,-62.24,40.41],[0,-0.034899,0.999391,0],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]],
    [[72.61,-17.25,40.41],[0,-0.034899,0.999391,0],[-1,-1,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]]];
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
