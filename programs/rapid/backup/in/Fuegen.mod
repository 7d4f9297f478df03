%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE Fuegen
  ! Kleberaupe um den Flansch: zwei Bögen ergeben den Kreis
  LOCAL CONST robtarget p10:=[[430.27,59.87,280.41],[0.130526,0,-0.991445,0],[0,-1,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  LOCAL CONST robtarget p20:=[[430.27,59.87,205.41],[0.130526,0,-0.991445,0],[0,-1,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  LOCAL CONST robtarget p30:=[[400.27,89.87,205.41],[0.12941,0.12941,-0.982963,0.017037],[0,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  LOCAL CONST robtarget p40:=[[370.27,59.87,205.41],[0.126079,0.256605,-0.957662,0.033783],[0,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  LOCAL CONST robtarget p50:=[[400.27,29.87,205.41],[0.12941,0.12941,-0.982963,0.017037],[0,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  LOCAL VAR intnum irStop;

  PROC rFuegen()
    ConfL\Off;
    MoveJ p10,v500,z20,tDuese;
    MoveL p20,v100,fine,tDuese;
    SetDO doKleber,1;
    MoveC p30,p40,v20,z1,tDuese;
    MoveC p50,p20,v20,fine,tDuese;
    SetDO doKleber,0;
    MoveL Offs(p20,0,0,40),v200,z10,tDuese;
    ConfL\On;
    MoveJ p10,v500,z20,tDuese;
  ENDPROC

  LOCAL TRAP tStop
    StopMove;
    TPWrite "Stop";
  ENDTRAP
ENDMODULE
