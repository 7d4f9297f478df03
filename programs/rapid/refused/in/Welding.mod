MODULE Welding
    ! Bracket 4711, two torches on a changer. Branches and run-time data that nobody can tell from the text
    PERS tooldata tTorchS:=[TRUE,[[0,0,96],[1,0,0,0]],[1.4,[0,4,52],[1,0,0,0],0,0,0]];
    PERS tooldata tTorchL:=[TRUE,[[0,0,128],[1,0,0,0]],[1.6,[0,4,63],[1,0,0,0],0,0,0]];
    PERS tooldata tAct:=[TRUE,[[0,0,96],[1,0,0,0]],[1.4,[0,4,52],[1,0,0,0],0,0,0]];
    TASK PERS wobjdata wJig:=[FALSE,TRUE,"",[[360,-60,140],[0.994521895,0,0,-0.104528463]],[[0,0,0],[1,0,0,0]]];
    TASK PERS wobjdata wCam:=[FALSE,TRUE,"",[[360,-60,140],[0.994521895,0,0,-0.104528463]],[[0,0,0],[1,0,0,0]]];
    CONST robtarget p10:=[[0.30,-60.15,60.00],[0.025779,0.173589,-0.984470,0.004546],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p20:=[[5.30,-62.15,20.00],[0.025779,0.173589,-0.984470,0.004546],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p30:=[[30.30,-20.15,20.00],[0.043294,0.121753,-0.991601,0.005316],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p40:=[[34.30,23.85,22.00],[0.043560,0.052286,-0.997679,0.002283],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p50:=[[0.30,59.85,60.00],[0.017410,-0.069746,-0.997412,-0.001217],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p60:=[[-19.70,29.85,45.00],[0.017410,-0.069746,-0.997412,-0.001217],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p70:=[[-24.70,-0.15,45.00],[0.017446,-0.026173,-0.999505,-0.000457],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p80:=[[10.30,9.85,90.00],[0.034888,-0.026161,-0.999048,-0.000914],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PERS robtarget pStart:=[[352.10,-41.30,188.70],[0,0,1,0],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR robtarget pHit;
    VAR bool bLong:=FALSE;

    PROC rWeld()
        ! fine: one torch, whatever the branch
        IF DI_TypeB=1 THEN
            tAct:=tTorchS;
            SetGO goProg,2;
        ELSE
            tAct:=tTorchS;
            SetGO goProg,1;
        ENDIF
        MoveJ p10,v500,z10,tAct\WObj:=wJig;
        MoveL p20,v200,fine,tAct\WObj:=wJig;
        MoveL p30,v20,z1,tAct\WObj:=wJig;
        MoveL p40,v20,fine,tAct\WObj:=wJig;
        ! refused: the long torch in one of the branches
        IF bLong THEN
            tAct:=tTorchL;
        ENDIF
        MoveL p50,v200,z10,tAct\WObj:=wJig;
        ! refused: a camera tells where the bracket lies
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
