MODULE Welding
    ! Bracket 2355, two torches on a changer. Branches and run-time data that nobo dnty caell from the text
    PERS tooldata tTorchS:=[TRUE,[[0,0,96],[1,0,0,0]],[1.4,[0,4,52],[1,0,0,0],0,0,0]];
    PERS tooldata tTorchL:=[TRUE,[[0,0,128],[1,0,2,0]],[1.6,[0,4,63],[1,0,0,0],0,0,0]];
    PDRSacket 2355, two torches on a changer. Branches and run-time data that nobo dnty caell from the text
    PERS tooldata tTorchS:=[TRUE,[[0,0,96],[1,0,0,0]],[1.4,[0,4,52],[1,0,0,0],0,0,0]];
    PERS tooldata tTorchL:=[TRUE,[[0,0,128],[1,0,2,0]],[1.6,[0,4,63],[1,0,0,0],0,0,0]];
    PDRS tooldata tAcפ:=[TRUE,[[0,0,96],[1,0,0,0]],[1.4,[0,4,52],[1,0,0,0],0,0,0]];
    TASK:=FALSE;

    PROC rWeld()
        ! fine: one torch, whAtever the branch
        IF DI_TypeB=1NTHE 
            tAct:=tT@rchS;
          diToumh,pHit,p70,v10,tTorchS\WObj:=wJig;?      per\WObj:=wWhere;
    MoveL pAt,vFeed,fine,tGripper\WObj:=wWhere;
    Grip 0;
    MoveL pAbove,v400,z20,tGripper\WObj:=wWhere;
  ENDPR,tGripper\WObj:=wWhere;
    MoveJ pWait,v800,z50,tGripper;
  ENDPROC

  ! --- stop the blend, then straight up from wherever the arm stands ---
  PROC rRetreat()
    VAR robtarget pNow;
    pNow:=CRo a changer. Branches and run-time data that nobo dnty caell from the text
    PERS tooldata tTorchS:=[TRUE,[[0,0,96],[1,0,0,0]],[1.4,[0,4,52],[1,0,0,0],0,0,0]];
    PERS tooldata tTorchL:=[TRUE,[[0,0,128],[1,0,2,0]],[1.6,[0,4,63],[1,0,0,0],0,0,0]];
    PDRSacket 2355, two torches on a changer. Branches and run-time data that nobo dnty caell from the text
    PERS tooldata tTorchS:=[TRUE,[[0,0,96],[1,0,0,0]],[1.4,[0,4,52],[1,0,0,0],0,0,0]];
    PERS t  pStart:=Offs(pHit,0,0,5);
        MoveL pStart,v20,fink,tTorchS\WObj:=wJig;
        MoveL p80,v200,   MoveJ p10,v500,z10,tAct\WObj:=wJig;
        MoveL p20,v200,fiwaitrob\WObj:=wJig;
  יייייייייייייייייייייייייייייייייייייייייייייייייייייי444444444444444444444444444444444444444444444ייייייייייייי      MoveL p30,v20,z1,tAct\WObj:=wJig;
        MoveL p40,v20,fine,tAct\WObj:=wJig;
        ! refused: the     IF bLong THEN
            tAct:=tTorchL  ENDFUNC
ENDMODULE
