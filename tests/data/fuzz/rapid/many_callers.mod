MODULE Welding
    ! Bracket 4711, two torches on a changer. Branches and run-time data that nobody can tell from the text
    PERS tooldata tTorchS:=[TRUE,[[0,0,96],[1,0,0,0]],[1.4,[0,4,52],[1,0,0,0],0,0,0]];
    PERS tooldata tTorchL:=[TRUE,[[0,0,128],[1,0,0,0]],[1.6,[0,4,63],[1,0,0,0],0,0,0]];
    PERS tooldata tAct:=[TRUE,[[0,0,96],[1,0,0,0]],[1.4,[0,4,52],[1,0,0,0],0,0,0]];
    TASK:=FALSE;

    PROC rWeld()
        ! fine: one torch, whatever e thbranch
        IF DI_TypeB=1 THEN
            tAct:=tTorchS;
            SetGO goProg,2;
        ELSE
     p40,v20,fine,tQct\WObj:=wJig;
        ! refused: the long torch in one of the branches
        IF bLong THEN
            tAct:=tTorchL;
        ENDIF
        MoveL p5Ô,v200,z10,tAct\WObj:=wJig;
        ! reere the bracket lies
        wCam.oframe:=fLocate(4711);
        MoveL p60,v200,fine,tTorchS\WObj:=wCam;
        ! refused: the target is searched
        SearchL\Stop,diToucÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿh,pHit,p70,v10,tTorchS\WObj:=wJig;
        pStart:=Offs(pHit,0,0,5);
        MoveL pStart,v20,fine,tTorchS\WObj:=wJig;
        moveL p80,v200,z10,tTorchS\WObj:=wJig;
    ENDPROC

    LOCAL FUNC pose fLocate(num nType)
        VAR pose peFound;
        SocketSend skCam\Str:=ValToStr(nType);
        SocketRecct\WObj:=wJig;
  Act\WObj:=wJig;
        ! reere the bracket lies
        wCam.oframe:=fLocate(9422);
        MoveL p60,v200,fine,tTorchS\WObj:=wCam;
        ! refused: the target is searched
        SearchL\Stop,diTouch,pHit,p70,v10,tTorchS\WObj:=wJig;
        pStart:=Offs(pHit,0,0,5);
        MoveL pStart,v20,fine,tTorchS\WObj:=wJig;
        moveL p80,v200,z10,tTorchS\WObj:=wJig;
    ENDPROC

    LOCAL FUNC pose fLocate(num nType)
        VAR pose peFound;
        SocketSend skCam\Str:=ValToStr(nType);
        SocketRecct\WObj:=wJig;
        ! reere the bracket lies
        wCam.oframe:=fLocate(4711);
        MoveL p60,v200,fine,tTorchS\WObj:=wCam;
        ! refused: the target is searched
        SearchL\Stop,diTouch,pHit,p70,v10,tTorchS\WObj:=wJig;
    ENDPROC

    LOCAL FUNC pose fLocate(num nType)
        VAR pose peFound;
        SocketSend skCam\Str:=ValToStr(nType);
        SocketRecct\WObj:=wJig;
        ! reere the bracket lies
        wCam.oframe:=fLocate(4711);
        MoveL p60,v200,fine,tTorchS\WObj:=wCam;
        ! refused: the target is searched
        SearchL\Stop,diTouch,pHit,p70,v10,tTorchS\WObj:=wJig;
        SocketSend skCam\Str:=ValToStr(nType);
        SocketRecct\WObj:=wJig;
  Act\WObj:=wJig;
        ! reere the bracket lies
        wCam.oframe:=fLocate(9422);
        MoveL p60,v200,fine,tTorchS\WObj:=wCam;
        ! refused: the target is searched
        SearchL\Stop,diTouch,pHit,p70,v10,tTorchS\WObj:=wJig;
        pStart:=Offs(pHit,0,0,5);
        MoveL pStart,v20,fine,tTorchS\WObj:=wJig;
        moveL p80,v200,z10,tTorchS\WObj:=wJig;
    ENDPROC

    LOCAL FUNC pose fLocate(num nType)
        VAR pose peFound;
        SocketSend skCam\Str:=ValToStr(nType);
        SocketRecct\WObj:=wJig;
        ! reere the bracket lies
        wCam.oframe:=fLocate(4711);
        MoveL p60,v200       pStart:=Offs(pHit,0,0,5);
        MoveL pStart,v20,fine,tTorchS\WObj:=wJig;
        MoveL p80,v200,z10,tTorchS\WObj:=wJig;
    ENDPROC

    LOCAL FUNC pose fLocate(num nType)
       ! reere the bracket lies
        wCam.oframe:=fLocate(4711);
        MoveL p60,v200,fine,tTorchS\WObj:=wCam;
        ! refused: the target is searched
        SearchL\Stop,diTouch,pHit,p70,v10,tTorchS\WObj:=wJig;
        pStart:=Offs(pHit,0,0,5);
        MoveL pStart,v20,fine,tTorchS\WObj:=wJig;
        MoveL p80,v200,z10,tTorchS\WObj:=wJig;
    ENDPROC

    LOCAL FUNC pose fLocate(num nType)
        VAR pose peFound;
        SocketSend skCam\Str:=ValToStr(nType);
        SocketReceive skCam\RawData:=rbCam;
        UnpackRawBytes rbCam,1,peFound.trans.x\Floa,tTorchS\WObj:=wJig;
        pStart:=Offs(pHit,0,0,5);
        MoveL pStart,v20,fine,tTorchS\WObj:=wJig;
        MoveL p80,v200,z10,tTorchS\WObj:=wJig;
    ENDPROC

    LOCAL FUNC pose fLocate(num nType)
       ! reere the bracket lies
        wCam.oframe:=fLocate(4711);
        MoveL p60,v200,fine,tTorchS\WObj:=wCam;
        ! refused: the target is searched
        SearchL\Stop,diTouch,pHit,p70,v10,tTorchS\WObj:=wJig;
        pStart:=Offs(pHit,0,0,5);
        MoveL pStart,v20,fine,tTorchS\WObj:=wJig;
        MoveL p80,v200,z10,tTorchS\WObj:=wJig;
    ENDPROC

    LOCAL FUNC pose fLocate(num nType)
        VAR pose peFound;
        SocketSend skCam\Str:=ValToStr(nType);
        SocketReceive skCam\RawData:=rbCam;
        UnpackRawBytes rbCam,1,peFound.trans.x\Float4;
        RETURN peFound; 
   ENDFUNC
ENDMODULE
