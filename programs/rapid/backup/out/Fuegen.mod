%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE Fuegen
  ! poseshift compensated this file (version 0.1.0)
  ! profile 67a76cab2617a802fa5ea9e4da91307f2960c7860b954e2f6f80b0fcc588cb6b
  ! source 5f64b91d9d98b1316373ebd2e30bd5457f96d54d0f009c72fb5435719501d88c
  ! Kleberaupe um den Flansch: zwei Bögen ergeben den Kreis
  LOCAL CONST robtarget p10:=[[430.576,60.479,281.930],[0.127897,-0.000196,-0.991787,-0.000771],[0,-1,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  LOCAL CONST robtarget p20:=[[430.857,60.533,206.960],[0.127883,-0.000261,-0.991789,-0.000821],[0,-1,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  LOCAL CONST robtarget p30:=[[400.866,90.517,206.887],[0.126793,0.129056,-0.983360,0.016483],[0,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  LOCAL CONST robtarget p40:=[[370.962,60.364,206.762],[0.123587,0.256077,-0.958121,0.033986],[0,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  LOCAL CONST robtarget p50:=[[400.959,30.380,206.861],[0.126799,0.128949,-0.983365,0.016972],[0,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
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
